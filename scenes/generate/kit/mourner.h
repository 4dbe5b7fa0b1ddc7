// SPDX-License-Identifier: MIT
// A mourner in a hooded cloak, as they stand around tombs, cut from marble: an implicit surface.
#pragma once

#include <glm/glm.hpp>

#include "noise.h"

namespace lodestir::generate {

class Mourner {
public:
    /// Metres; below 0 inside the stone. The foot of the plinth stands on y = 0, the face looks along +z.
    float distance(const glm::vec3& p) const;

    static constexpr glm::vec3 low{-0.62f, -0.02f, -0.62f}, high{0.62f, 2.08f, 0.62f};  ///< hold all of it

private:
    float cloak(const glm::vec3& p) const;
    float hood(const glm::vec3& p) const;
    float arms(const glm::vec3& p) const;
    float hands(const glm::vec3& p) const;
    float face(const glm::vec3& p) const;
    float plinth(const glm::vec3& p) const;
    /// How far the cloth stands out from the body: folds that fall from the shoulders and open towards the hem.
    float folds(const glm::vec3& p) const;
    /// What tools and weather left on the stone.
    float relief(const glm::vec3& p) const;

    Noise noise{1410, {}};
};

}  // namespace lodestir::generate
