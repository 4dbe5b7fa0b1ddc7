// SPDX-License-Identifier: MIT
#include <framework/app/view/picking.h>

#include <framework/scene/bvh/box.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace lodestir {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

struct Ray {
    glm::dvec3 origin, direction;
};

/// How far along the ray it comes into the box; infinity where it doesn't.
double entry(const Ray& ray, const Box& box) {
    if (box.isEmpty()) return infinity;
    double from = 0, to = infinity;
    for (int axis = 0; axis < 3; ++axis) {
        const double a = (double(box.low[axis]) - ray.origin[axis]) / ray.direction[axis],
                     b = (double(box.high[axis]) - ray.origin[axis]) / ray.direction[axis];
        if (std::isnan(a) || std::isnan(b)) continue;  // along a face: the other axes decide
        from = std::max(from, std::min(a, b));
        to = std::min(to, std::max(a, b));
    }
    return from <= to ? from : infinity;
}

/// How far along the ray it meets the triangle, from whichever side (Moeller and Trumbore 1997); infinity where it doesn't.
double meeting(const Ray& ray, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    const glm::dvec3 ab = b - a, ac = c - a, p = glm::cross(ray.direction, ac), from = ray.origin - a, q = glm::cross(from, ab);
    const double determinant = glm::dot(ab, p), u = glm::dot(from, p) / determinant, v = glm::dot(ray.direction, q) / determinant;
    const double t = glm::dot(ac, q) / determinant;
    return u >= 0 && v >= 0 && u + v <= 1 && t > 0 ? t : infinity;  // false where any is no number
}

/// A level of a mesh as the pose has it.
struct Shape {
    const MeshLevel* level;
    PosedVertices posed;  ///< empty: as the file has it
    Box box;
    const std::vector<glm::vec3>& positions() const { return posed.positions.empty() ? level->positions : posed.positions; }
};

Shape shapeOf(const Scene& scene, std::uint32_t mesh, std::size_t level, const Pose& pose) {
    Shape shape{.level = &scene.meshes[mesh].levels[level], .posed = {}, .box = {}};
    if (scene.meshes[mesh].deforms()) shape.posed = deform(scene, mesh, level, pose);
    shape.box = boundsOf(std::span<const glm::vec3>(shape.positions()));
    return shape;
}

}  // namespace

std::optional<Picked> pick(const Scene& scene, const Pose& pose, std::span<const std::uint32_t> levels, const ViewRay& view) {
    const Ray ray{view.origin, view.direction};
    std::map<std::pair<std::uint32_t, std::size_t>, Shape> shapes;  // of a mesh and level
    struct Candidate {
        double from;
        std::uint32_t instance;
        const Shape* shape;
        Ray ray;  ///< in the mesh's own space, as long as the ray
    };
    std::vector<Candidate> candidates;
    for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
        const std::uint32_t mesh = scene.instances[i].mesh;
        const std::size_t level = std::min<std::size_t>(levels[i], scene.meshes[mesh].levels.size() - 1);
        const glm::dmat4 toMesh = glm::inverse(glm::dmat4(scene.instanceMatrix(scene.instances[i], pose.nodes)));
        const Ray there{toMesh * glm::dvec4(ray.origin, 1), glm::dmat3(toMesh) * ray.direction};
        auto shape = shapes.find({mesh, level});
        if (shape == shapes.end()) shape = shapes.emplace(std::pair(mesh, level), shapeOf(scene, mesh, level, pose)).first;
        const double from = entry(there, shape->second.box);
        if (from < infinity) candidates.push_back({from, i, &shape->second, there});
    }
    std::ranges::sort(candidates, {}, &Candidate::from);
    double nearest = infinity;
    std::optional<Picked> picked;
    for (const Candidate& candidate : candidates) {
        if (candidate.from > nearest) break;
        const std::vector<glm::vec3>& positions = candidate.shape->positions();
        const MeshLevel& level = *candidate.shape->level;
        for (std::size_t k = 0; k < level.triangles.size(); ++k) {
            const glm::uvec3 t = level.triangles[k];
            const double distance = meeting(candidate.ray, positions[t.x], positions[t.y], positions[t.z]);
            if (distance >= nearest) continue;
            nearest = distance;
            picked = Picked{candidate.instance, level.materials[k], glm::vec3(ray.origin + distance * ray.direction)};
        }
    }
    return picked;
}

}  // namespace lodestir
