// SPDX-License-Identifier: MIT
// A ball whose normal picture is noise, glossy: what a texel averages away has to come back as a wider highlight.
#include <cmath>

#include "kit/backdrop.h"
#include "kit/noise.h"
#include "kit/scene.h"
#include "kit/shapes.h"

namespace lodestir::generate {

static Glb makeBumps() {
    Glb glb;
    const Noise noise{17};
    const Textures pictures = paintSphere(2048, 1024, [&](const glm::vec3& d) {
        Surface s;
        s.color = glm::vec3(0.55f, 0.57f, 0.60f);
        s.roughness = std::sqrt(0.05f);  // alpha 0.05
        s.height = 0.008f * noise.fractal(d * 38.0f, 3, 0.5f);
        return s;
    });
    Material metal = glb.dressed({.name = "bumps", .roughness = std::sqrt(0.05f), .metalness = 1}, pictures);
    Model model{"bumps", {}};
    model.add(glb.addMaterial(metal), sphere(192, 96));
    glb.addNode(model);
    addLamp(glb, {0, 0, 0}, 1, {11, 10.2f, 9});
    return glb;
}

LODESTIR_SCENE(makeBumps)

}  // namespace lodestir::generate
