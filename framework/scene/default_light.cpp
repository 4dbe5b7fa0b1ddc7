// SPDX-License-Identifier: MIT
#include <framework/scene/default_light.h>

#include <framework/image/srgb.h>
#include <framework/scene/bvh/box.h>
#include <framework/scene/deformation.h>
#include <framework/scene/sky.h>

#include <fmt/format.h>
#include <glm/gtc/constants.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace lodestir {
namespace {

/// Mean over an emissive texture of each texel's brightest channel, linear; of large ones over some texels.
float meanBrightness(const Texture& texture) {
    const std::size_t texels = texture.rgba.size() / 4, step = std::max<std::size_t>(1, texels / 65536) | 1;  // odd: not a column of its own
    double sum = 0;
    std::size_t count = 0;
    for (std::size_t i = 0; i < texels; i += step, ++count) {
        const std::uint8_t* texel = &texture.rgba[4 * i];
        sum += decodeSrgb(static_cast<float>(std::max({texel[0], texel[1], texel[2]})) / 255);
    }
    return count > 0 ? static_cast<float>(sum / static_cast<double>(count)) : 0.0f;
}

/// Does the scene light itself? Lights do. Emissive triangles do where their light, spread over the sphere around the scene, would make a
/// white surface brighter than 0.03; less is a display or a pilot lamp on a model that was meant for a viewer with a light of its own.
/// Unlit surfaces are seen without light, but were not made to light others: they do only where there is nothing else.
bool hasLight(const Scene& scene) {
    if (!scene.lights.empty()) return true;
    if (std::ranges::all_of(scene.materials, &Material::unlit)) return true;
    const Pose pose = poseAt(scene, 0);
    std::vector<float> shares(scene.textures.size(), -1);
    const auto shareOf = [&](const TextureSlot& map) {
        if (map.texture == none) return 1.0f;
        float& share = shares[map.texture];
        if (share < 0) share = meanBrightness(scene.textures[map.texture]);
        return share;
    };
    const auto shines = [&](std::uint32_t material) { return scene.materials[material].isLight(); };
    double power = 0;  // over pi
    for (const Instance& instance : scene.instances) {
        const MeshLevel& level = scene.meshes[instance.mesh].levels[0];
        if (std::ranges::none_of(level.materials, shines)) continue;
        const std::vector<glm::vec3> positions = deform(scene, instance.mesh, 0, pose).positions;
        const glm::mat3 linear(scene.instanceMatrix(instance, pose.nodes));
        for (std::size_t t = 0; t < level.triangles.size(); ++t) {
            const Material& material = scene.materials[level.materials[t]];
            if (!shines(level.materials[t])) continue;
            const glm::uvec3 v = level.triangles[t];
            const glm::vec3 normal = glm::cross(linear * (positions[v.y] - positions[v.x]), linear * (positions[v.z] - positions[v.x]));
            power += 0.5 * glm::length(normal) * shareOf(material.emissiveMap) * std::max({material.emission.r, material.emission.g, material.emission.b});
        }
    }
    const auto bounds = scene.bounds();
    const double radius = 0.5 * glm::length(bounds[1] - bounds[0]);
    return power > 0 && power / (4 * glm::pi<double>() * radius * radius) > 0.03;
}

constexpr std::size_t directions = 32;

/// Spread evenly over the sphere, from straight up to straight down (a Fibonacci lattice).
glm::vec3 direction(std::size_t i) {
    const float y = 1 - 2 * float(i) / (directions - 1), r = std::sqrt(std::max(1 - y * y, 0.0f)), angle = 2.3999632f * float(i);
    return {r * std::cos(angle), y, r * std::sin(angle)};
}

/// Where a ray meets a triangle (Moeller and Trumbore 1997); infinity where it doesn't.
float meet(glm::vec3 origin, glm::vec3 along, glm::vec3 a, glm::vec3 b, glm::vec3 c) {
    const glm::vec3 e = b - a, f = c - a, p = glm::cross(along, f), s = origin - a, q = glm::cross(s, e);
    const float inverse = 1 / glm::dot(e, p), u = glm::dot(s, p) * inverse, v = glm::dot(along, q) * inverse, t = glm::dot(f, q) * inverse;
    return u >= 0 && v >= 0 && u + v <= 1 && t > 0 ? t : std::numeric_limits<float>::infinity();
}

/// Finest levels of a scene's instances as they stand at frame 0, for a few rays.
class Surroundings {
public:
    explicit Surroundings(const Scene& scene) : scene_(scene), pose_(poseAt(scene, 0)), posed_(scene.meshes.size()), boxes_(scene.meshes.size()) {
        for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
            if (scene.meshes[m].deforms()) posed_[m] = deform(scene, m, 0, pose_).positions;
            boxes_[m] = boundsOf(positions(m));
        }
    }

    /// Distance to the nearest opaque surface, infinity where there is none.
    float distance(glm::vec3 origin, glm::vec3 along) const {
        float nearest = std::numeric_limits<float>::infinity();
        for (const Instance& instance : scene_.instances) {
            const glm::mat4 toWorld = scene_.instanceMatrix(instance, pose_.nodes);
            if (glm::determinant(glm::mat3(toWorld)) == 0) continue;  // nothing of it is seen
            const glm::mat4 toObject = glm::inverse(toWorld);
            const glm::vec3 from(toObject * glm::vec4(origin, 1)), way = glm::mat3(toObject) * along;
            const Box& box = boxes_[instance.mesh];
            const glm::vec3 a = (box.low - from) / way, b = (box.high - from) / way, low = glm::min(a, b), high = glm::max(a, b);
            if (std::max({low.x, low.y, low.z, 0.0f}) > std::min({high.x, high.y, high.z, nearest})) continue;
            const MeshLevel& level = scene_.meshes[instance.mesh].levels[0];
            const std::span<const glm::vec3> p = positions(instance.mesh);
            for (std::size_t i = 0; i < level.triangles.size(); ++i) {
                const Material& material = scene_.materials[level.materials[i]];
                if (material.alphaMode != AlphaMode::opaque || material.transmission > 0) continue;
                const glm::uvec3 t = level.triangles[i];
                nearest = std::min(nearest, meet(from, way, p[t.x], p[t.y], p[t.z]));
            }
        }
        return nearest;
    }

private:
    std::span<const glm::vec3> positions(std::size_t mesh) const {
        return scene_.meshes[mesh].deforms() ? posed_[mesh] : scene_.meshes[mesh].levels[0].positions;
    }

    const Scene& scene_;
    Pose pose_;
    std::vector<std::vector<glm::vec3>> posed_;  ///< of the meshes that deform
    std::vector<Box> boxes_;                     ///< of each mesh
};

/// A distance to what is around a point that a quarter of it is nearer than, or nothing where some direction leads out of the scene.
std::optional<float> shellAround(const Scene& scene, glm::vec3 point) {
    const Surroundings surroundings(scene);
    std::array<float, directions> distances;
    for (std::size_t i = 0; i < directions; ++i) {  // straight up first: that is where most scenes are open
        distances[i] = surroundings.distance(point, direction(i));
        if (!std::isfinite(distances[i])) return std::nullopt;
    }
    std::ranges::nth_element(distances, distances.begin() + directions / 4);
    return distances[directions / 4];
}

void addLamp(Scene& scene, glm::vec3 eye, float distance) {
    std::uint32_t node = scene.camera.node;  // rides along with a camera of the model
    if (node == none) {
        node = static_cast<std::uint32_t>(scene.nodes.size());
        scene.nodes.push_back({.name = "added lamp", .translation = eye});
    }
    // A white surface at that distance has a radiance of one.
    scene.lights.push_back({.name = "added lamp", .intensity = glm::pi<float>() * distance * distance, .node = node});
    scene.notes.push_back("there is no light and the camera stands in a closed shell, so a lamp at the camera is added");
}

void addSky(Scene& scene, bool keepExposure) {
    // A white surface in this sun and sky has a radiance near 5; two stops down it is near 1.
    constexpr float exposure = -2;
    scene.environment = makeSky({});
    if (!keepExposure) scene.exposure = exposure;
    scene.notes.push_back(fmt::format("there is no light, so a clear sky with the sun is added; exposure {} stops", scene.exposure));
}

}  // namespace

void addDefaultLight(Scene& scene, bool keepExposure) {
    if (hasLight(scene)) return;
    const glm::vec3 eye = scene.cameraAt(0).position;
    const std::optional<float> shell = shellAround(scene, eye);
    if (shell)
        addLamp(scene, eye, *shell);
    else
        addSky(scene, keepExposure);
}

}  // namespace lodestir
