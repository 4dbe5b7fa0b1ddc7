// SPDX-License-Identifier: MIT
#include <framework/scene/upload/light_list.h>

#include <framework/image/srgb.h>
#include <framework/scene/upload/cumulative_table.h>
#include <framework/scene/axes.h>
#include <framework/scene/shading_frame.h>

#include <glm/gtc/constants.hpp>

#include <array>
#include <cmath>

namespace lodestir {
namespace {

float luminance(glm::vec3 c) { return glm::dot(c, glm::vec3(0.2126f, 0.7152f, 0.0722f)); }

/// Texel at uv by the nearest-texel rule with repetition: good enough for a sampling weight.
glm::vec3 texelAt(const Texture& texture, glm::vec2 uv) {
    const glm::vec2 wrapped = uv - glm::floor(uv);
    const int x = std::min(texture.width - 1, int(wrapped.x * float(texture.width)));
    const int y = std::min(texture.height - 1, int(wrapped.y * float(texture.height)));
    const std::uint8_t* texel = &texture.rgba[4 * (std::size_t(y) * std::size_t(texture.width) + std::size_t(x))];
    return {decodeSrgb(float(texel[0]) / 255), decodeSrgb(float(texel[1]) / 255), decodeSrgb(float(texel[2]) / 255)};
}

/// Mean emitted luminance of a triangle: its texture at points spread over it, and a floor so that no lit texel is out of reach.
float meanEmission(const Scene& scene, const MeshLevel& level, glm::uvec3 triangle, const Material& material) {
    const float factor = luminance(material.emission);
    const TextureSlot& slot = material.emissiveMap;
    const auto& uvs = slot.uvSet == 1 ? level.uv1 : level.uv0;
    if (slot.texture == none || uvs.empty()) return factor;
    const Texture& texture = scene.textures[slot.texture];
    constexpr int points = 16;
    float sum = 0;
    for (int i = 0; i < points; ++i) {
        // Low-discrepancy points folded into the triangle (Roberts' R2 sequence).
        glm::vec2 b = glm::fract(glm::vec2(0.7548777f, 0.5698403f) * float(i + 1));
        if (b.x + b.y > 1) b = 1.0f - b;
        const glm::vec2 uv = uvs[triangle.x] * (1 - b.x - b.y) + uvs[triangle.y] * b.x + uvs[triangle.z] * b.y;
        sum += luminance(texelAt(texture, transformUv(slot, uv)) * material.emission);
    }
    return sum / points + 0.05f * factor;
}

float triangleArea(std::span<const glm::vec4> positions, glm::uvec3 t, const glm::mat4& toWorld) {
    const glm::mat3 linear(toWorld);
    return 0.5f * glm::length(glm::cross(linear * glm::vec3(positions[t.y] - positions[t.x]), linear * glm::vec3(positions[t.z] - positions[t.x])));
}

LightRecord pointlike(const Light& light, const glm::mat4& toWorld) {
    LightRecord record{};
    record.type = light.type == LightType::point ? LIGHT_POINT : light.type == LightType::spot ? LIGHT_SPOT : LIGHT_DIRECTIONAL;
    record.instance = record.primitive = NONE;
    record.position = glm::vec3(toWorld[3]);
    record.direction = -unitAxes(toWorld)[2];
    record.intensity = light.color * light.intensity;
    record.cosInner = std::cos(light.innerCone);
    record.cosOuter = std::cos(std::max(light.outerCone, light.innerCone + 1e-4f));
    record.range = light.range;
    return record;
}

}  // namespace

LightList listLights(const Scene& scene, std::span<const MeshEmitters> emitters, std::span<const std::span<const glm::vec4>> positions,
                     const std::vector<glm::mat4>& nodeMatrices, float sceneRadius) {
    constexpr double pi = glm::pi<double>();
    LightList list;
    list.firstLight.assign(scene.instances.size(), NONE);
    enum Kind { triangles, points, environment, kinds };
    std::vector<double> power;
    std::vector<Kind> kindOf;

    for (std::size_t i = 0; i < scene.instances.size(); ++i) {
        const Instance& instance = scene.instances[i];
        const MeshEmitters& mesh = emitters[instance.mesh];
        if (mesh.empty()) continue;
        const MeshLevel& level = scene.meshes[instance.mesh].levels[0];
        list.firstLight[i] = std::uint32_t(list.lights.size());
        for (std::size_t k = 0; k < mesh.primitives.size(); ++k) {
            LightRecord record{};
            record.type = LIGHT_TRIANGLE;
            record.instance = std::uint32_t(i);
            record.primitive = mesh.primitives[k];
            const Material& material = scene.materials[mesh.materials[k]];
            const float area = triangleArea(positions[instance.mesh], mesh.triangles[k], scene.instanceMatrix(instance, nodeMatrices));
            power.push_back(pi * area * meanEmission(scene, level, mesh.triangles[k], material) * (material.doubleSided ? 2 : 1));
            kindOf.push_back(triangles);
            list.lights.push_back(record);
        }
    }

    const double disk = pi * double(sceneRadius) * double(sceneRadius);
    for (const Light& light : scene.lights) {
        const LightRecord record = pointlike(light, nodeMatrices[light.node]);
        const double strength = luminance(record.intensity);
        power.push_back(record.type == LIGHT_DIRECTIONAL ? strength * disk
                        : record.type == LIGHT_POINT     ? strength * 4 * pi
                                                         : strength * 2 * pi * (1 - 0.5 * (record.cosInner + record.cosOuter)));
        kindOf.push_back(points);
        list.lights.push_back(record);
    }

    double irradiance = 0;
    const Environment& map = scene.environment;
    for (int y = 0; y < map.height; ++y) {
        const double theta = pi * (y + 0.5) / map.height;
        const double solidAngle = 2 * pi / map.width * pi / map.height * std::sin(theta);
        for (int x = 0; x < map.width; ++x) irradiance += solidAngle * luminance(map.radiance[std::size_t(y) * std::size_t(map.width) + std::size_t(x)]);
    }
    if (irradiance > 0) {
        LightRecord record{};
        record.type = LIGHT_ENVIRONMENT;
        record.instance = record.primitive = NONE;
        list.environmentLight = std::uint32_t(list.lights.size());
        power.push_back(irradiance * disk);
        kindOf.push_back(environment);
        list.lights.push_back(record);
    }

    std::array<double, kinds> kindPower{};
    double total = 0;
    for (std::size_t i = 0; i < power.size(); ++i) {
        kindPower[kindOf[i]] += power[i];
        total += power[i];
    }
    int present = 0;
    for (double p : kindPower) present += p > 0;
    std::vector<double> weights(power.size(), 0.0);
    for (std::size_t i = 0; i < power.size(); ++i)
        if (power[i] > 0) weights[i] = 0.5 * power[i] / total + 0.5 / present * power[i] / kindPower[kindOf[i]];
    const std::vector<CumulativeEntry> table = makeCumulativeTable(weights);
    for (std::size_t i = 0; i < table.size(); ++i) {
        list.lights[i].pmf = table[i].pmf;
        list.lights[i].last = table[i].last;
        list.lights[i].start = table[i].start;
    }
    return list;
}

}  // namespace lodestir
