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

/// Lists the lights of an instance at a level, and adds the power of each.
void addTriangles(const Scene& scene, std::size_t instance, std::size_t level, const LevelEmitters& emitters, std::span<const glm::vec4> positions,
                  const glm::mat4& toWorld, std::vector<LightRecord>& lights, std::vector<double>& power) {
    const MeshLevel& mesh = scene.meshes[scene.instances[instance].mesh].levels[level];
    for (std::size_t k = 0; k < emitters.primitives.size(); ++k) {
        LightRecord record{};
        record.type = LIGHT_TRIANGLE;
        record.instance = std::uint32_t(instance);
        record.primitive = emitters.primitives[k];
        const Material& material = scene.materials[emitters.materials[k]];
        const float area = triangleArea(positions, emitters.triangles[k], toWorld);
        power.push_back(glm::pi<double>() * area * meanEmission(scene, mesh, emitters.triangles[k], material) * (material.doubleSided ? 2 : 1));
        lights.push_back(record);
    }
}

void setNumbers(std::span<LightRecord> lights, std::span<const CumulativeEntry> table) {
    for (std::size_t i = 0; i < table.size(); ++i) {
        lights[i].pmf = table[i].pmf;
        lights[i].last = table[i].last;
        lights[i].start = table[i].start;
    }
}

}  // namespace

LightList listLights(const Scene& scene, std::span<const std::vector<LevelEmitters>> emitters, const PositionsOfLevel& positions,
                     const std::vector<glm::mat4>& nodeMatrices, float sceneRadius) {
    constexpr double pi = glm::pi<double>();
    LightList list;
    list.firstLight.assign(scene.instances.size(), NONE);
    list.coarserLights.assign(scene.instances.size(), NONE);
    enum Kind { triangles, points, environment, kinds };
    std::vector<double> power;
    std::vector<Kind> kindOf;

    const auto add = [&](std::size_t instance, std::size_t level, std::vector<double>& powers) {
        const std::size_t mesh = scene.instances[instance].mesh;
        const glm::mat4 toWorld = scene.instanceMatrix(scene.instances[instance], nodeMatrices);
        addTriangles(scene, instance, level, emitters[mesh][level], positions(mesh, level), toWorld, list.lights, powers);
    };
    for (std::size_t i = 0; i < scene.instances.size(); ++i) {
        if (emitters[scene.instances[i].mesh][0].empty()) continue;
        list.firstLight[i] = std::uint32_t(list.lights.size());
        add(i, 0, power);
    }
    kindOf.assign(power.size(), triangles);

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
    setNumbers(list.lights, makeCumulativeTable(weights));
    list.count = std::uint32_t(list.lights.size());

    std::uint64_t number = 0;
    for (std::size_t i = 0; i < scene.instances.size(); ++i) {
        if (list.firstLight[i] == NONE) continue;
        const std::vector<LevelEmitters>& levels = emitters[scene.instances[i].mesh];
        Numbers mine{number};
        for (std::size_t k = 0; k < levels[0].primitives.size(); ++k)
            if (const LightRecord& light = list.lights[list.firstLight[i] + k]; light.pmf > 0) number = std::uint64_t(light.last) + 1;
        mine.count = number - mine.first;
        if (levels.size() == 1) continue;
        list.coarserLights[i] = std::uint32_t(list.levels.size());
        for (std::size_t l = 1; l < levels.size(); ++l) {
            const std::size_t first = list.lights.size();
            list.levels.push_back(std::uint32_t(first));
            std::vector<double> powers;
            add(i, l, powers);
            setNumbers(std::span(list.lights).subspan(first), shareNumbers(powers, mine));
        }
        list.levels.push_back(std::uint32_t(list.lights.size()));
    }
    return list;
}

}  // namespace lodestir
