// SPDX-License-Identifier: MIT
// Bodies modelled in soft clay: limbs and lumps that run into each other, hollows pressed in. Kept as distances to the surface, meshed when done.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "mesh.h"
#include "shapes.h"

namespace lodestir::generate {

class Sculpture {
public:
    /// Where what is added next stands, rigid; and its width along its own z, as a share of what is given: animals are slimmer than they are tall.
    glm::mat4 frame{1};
    float slim = 1;

    /// Over how many metres what is added next runs into what is there (polynomial smooth minimum: I. Quilez, "Smooth minimum", 2013).
    float blend = 0.05f;

    /// Finer than parts can say: metres outward at a place, added to the whole.
    std::function<float(const glm::vec3&)> relief;

    /// A chain of round cones.
    void limb(std::span<const Station> stations);

    /// An ellipsoid whose axes are the columns of `axes`, with their lengths.
    void lump(const glm::vec3& centre, const glm::mat3& axes);

    /// The same, taken away.
    void hollow(const glm::vec3& centre, const glm::mat3& axes);

    /// Metres to the surface, negative inside. Close to the surface alone it is more than a bound.
    float distance(const glm::vec3& p) const;

    /// The surface by naive surface nets (Gibson 1998), cells of `cell` metres, vertices drawn onto the surface. No UVs.
    Mesh mesh(float cell) const;

private:
    struct Part {
        glm::mat4 toLocal;
        float blend, slim;
        bool isCarved, isRound;  ///< an ellipsoid in its unit sphere, or a round cone
        glm::vec3 from, to;      ///< of a cone; `to` of an ellipsoid: lengths of its axes
        float fromRadius, toRadius;

        float distance(glm::vec3 p) const;
    };
    std::vector<Part> parts;

    void ellipsoid(const glm::vec3& centre, const glm::mat3& axes, bool isCarved);
    float distance(const glm::vec3& p, std::span<const Part> near) const;
    glm::vec3 slope(const glm::vec3& p, std::span<const Part> near, float step) const;
};

}  // namespace lodestir::generate
