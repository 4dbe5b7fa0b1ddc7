// SPDX-License-Identifier: MIT
// Painted bodies: see figure.h.
#include "figure.h"

#include "atlas.h"

namespace lodestir::generate {

Model figure(Glb& glb, const std::string& name, const Mesh& charted, int texels,
             const std::function<Surface(const glm::vec3& position, const glm::vec3& normal)>& surface) {
    Model model{name, {}};
    model.parts.emplace_back(glb.addMaterial(glb.dressed({.name = name}, bake(charted, texels, surface))), charted);
    return model;
}

void cover(Surface& s, const glm::vec3& color, float roughness, float share, float metalness) {
    s.color = glm::mix(s.color, color, share);
    s.roughness = glm::mix(s.roughness, roughness, share);
    s.metalness = glm::mix(s.metalness, metalness, share);
    s.height *= 1 - share;
}

}  // namespace lodestir::generate
