// SPDX-License-Identifier: MIT
#include <framework/scene/panes.h>

#include <algorithm>

namespace lodestir {

bool isClear(const Material& m) { return m.transmission > 0 && (m.roughness < 0.0317f || m.metallicRoughnessMap.texture != none); }

bool isPane(const Material& m) { return m.alphaMode == AlphaMode::blend || (!m.solid && isClear(m)) || (m.unlit && !m.doubleSided); }

bool lightsShineThroughPanes(const Scene& scene) { return !scene.lights.empty() && std::ranges::any_of(scene.materials, isPane); }

}  // namespace lodestir
