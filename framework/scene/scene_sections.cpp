// SPDX-License-Identifier: MIT
// Environment, lights and camera of a scene file.
#include <framework/core/is_file.h>
#include <framework/scene/environment.h>
#include <framework/scene/fields.h>
#include <framework/scene/scene_sections.h>
#include <framework/scene/sky.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace lodestir {
namespace {

/// A rotation that turns -Z to a unit direction.
glm::quat rotationTo(glm::vec3 direction) {
    const glm::vec3 from(0, 0, -1);
    const float cosine = glm::dot(from, direction);
    if (cosine < -0.999999f) return glm::quat(0, 0, 1, 0);  // half a turn about +Y
    return glm::normalize(glm::quat(1 + cosine, glm::cross(from, direction)));
}

/// A direction that must not be zero, made unit.
void unitVector(Fields& fields, const char* key, glm::vec3& value) {
    glm::vec3 read = value;
    fields.vector(key, read);
    const glm::dvec3 wide(read);  // the square of a large float is none
    const double length = glm::length(wide);
    if (length > 0)
        value = glm::vec3(wide / length);
    else
        fields.problem(fields.find(key)->where(), fmt::format("\"{}\" of {} is zero and has no direction", key, fields.what()));
}

Environment readSky(Fields& fields) {
    Sky sky;
    unitVector(fields, "sunDirection", sky.sunDirection);
    fields.number("sunAngle", sky.sunAngle, 0.05, 90);
    fields.number("sunStrength", sky.sunStrength, 0);
    fields.number("turbidity", sky.turbidity, 1, 12);
    fields.color("ground", sky.ground);
    fields.finish();
    return fields.problems().empty() ? makeSky(sky) : Environment{};
}

Environment readMap(Fields& fields, const Path& folder, std::vector<std::string>& notes) {
    std::string file;
    const Json* value = fields.require("file");
    fields.text("file", file);
    fields.finish();
    if (!value || file.empty() || !fields.problems().empty()) return {};
    try {
        const Path path = namedPath(folder, file);
        if (!isFile(path)) throw Error(fmt::format("there is no file \"{}\"", path.string()));
        return loadEnvironmentMap(path, notes);
    } catch (const Error& error) {
        const Problem& problem = error.problems()[0];
        fields.problem(value->where(), problem.where.file.empty() ? problem.what : problem.where.file + ": " + problem.what, problem.hint);
        return {};
    }
}

void readLens(Fields& fields, CameraKey& key, bool& hasFocus) {
    float degrees = glm::degrees(key.fovy);
    fields.number("fovy", degrees, 0.01, 179);
    if (fields.find("fovy")) key.fovy = glm::radians(degrees);
    fields.number("aperture", key.aperture, 0);
    fields.number("focus", key.focus, 1e-6);
    hasFocus = hasFocus || fields.find("focus");
    fields.number("orthographic", key.height, 1e-6);
    if (key.height > 0 && (fields.find("fovy") || key.aperture > 0))
        fields.problem(fields.where(), fmt::format("{} is orthographic: it has neither an angle of view nor a lens", fields.what()),
                       "give \"orthographic\", or \"fovy\" and \"aperture\"");
}

CameraKey readKey(Fields& fields, CameraKey key, bool& hasFocus) {
    fields.vector("position", key.position);
    fields.vector("target", key.target);
    fields.vector("up", key.up);
    readLens(fields, key, hasFocus);
    const glm::vec3 view = key.target - key.position;
    if (!(glm::length(view) > 0)) {
        fields.problem(fields.where(), fmt::format("{} looks at its own position", fields.what()), "give it another \"target\"");
    } else if (!(glm::length(glm::cross(glm::normalize(view), key.up)) > 1e-6f * glm::length(key.up))) {
        fields.problem(fields.where(), fmt::format("\"up\" of {} points along its view or is zero", fields.what()));
    }
    if (!hasFocus) key.focus = std::max(glm::length(view), 1e-6f);
    return key;
}

}  // namespace

void readEnvironment(const Json& value, const Path& folder, Scene& scene, Problems& problems) {
    Fields fields(value, "the environment", problems);
    const std::vector<std::string> types{"constant", "sky", "map"};
    std::size_t type = types.size();
    if (!fields.require("type")) return;
    fields.choice("type", type, types);
    if (type == types.size()) return;  // which other keys are right depends on it
    glm::vec3 color(1);
    float strength = 1, degrees = 0;
    fields.color("color", color);
    fields.number("strength", strength, 0);
    if (type != 0) fields.number("rotationDegrees", degrees);

    Environment environment;
    if (type == 0) {
        fields.finish();
        environment.radiance = {glm::vec3(1)};
    } else {
        environment = type == 1 ? readSky(fields) : readMap(fields, folder, scene.notes);
    }
    for (glm::vec3& radiance : environment.radiance) radiance *= color * strength;
    environment.rotation = glm::radians(degrees);
    scene.environment = std::move(environment);
}

void readLights(const Json& value, Scene& scene, Problems& problems) {
    if (!value.isArray()) return problems.add(value.where(), fmt::format("\"lights\" must be an array, not {}", value.kindName()));
    for (std::size_t i = 0; i < value.items().size(); ++i) {
        Fields fields(value.items()[i], fmt::format("light {}", i), problems);
        const std::vector<std::string> types{"point", "spot", "directional"};
        std::size_t type = types.size();
        if (!fields.require("type")) continue;
        fields.choice("type", type, types);
        if (type == types.size()) continue;
        Light light{.name = fmt::format("light {}", i),
                    .type = static_cast<LightType>(type),
                    .node = static_cast<std::uint32_t>(scene.nodes.size())};
        Node node;
        fields.text("name", light.name);
        fields.color("color", light.color);
        fields.number("intensity", light.intensity, 0);
        if (light.type != LightType::directional) {
            fields.vector("position", node.translation);
            fields.number("range", light.range, 0);
        }
        if (light.type != LightType::point) {
            glm::vec3 direction(0, -1, 0);
            unitVector(fields, "direction", direction);
            node.rotation = rotationTo(direction);
        }
        if (light.type == LightType::spot) {
            float inner = 0, outer = 45;
            fields.number("outerConeDegrees", outer, 0.01, 90);
            fields.number("innerConeDegrees", inner, 0, outer);
            light.innerCone = glm::radians(inner);
            light.outerCone = glm::radians(outer);
        }
        fields.finish();
        node.name = light.name;
        scene.nodes.push_back(std::move(node));
        scene.lights.push_back(std::move(light));
    }
}

void readCamera(const Json& value, Scene& scene, Problems& problems) {
    Fields fields(value, "the camera", problems);
    bool hasFocus = false;
    CameraKey base;
    const Json* keyframes = fields.find("keyframes");
    if (!keyframes || fields.find("position") || fields.find("target"))
        base = readKey(fields, base, hasFocus);
    else
        readLens(fields, base, hasFocus);
    fields.allow({"position", "target", "up"});
    fields.finish();
    if (!keyframes) {
        scene.camera.keys = {base};
        return;
    }
    if (!keyframes->isArray() || keyframes->items().empty())
        return problems.add(keyframes->where(), "\"keyframes\" must be an array with at least one key");
    std::vector<CameraKey> keys;
    for (std::size_t i = 0; i < keyframes->items().size(); ++i) {
        Fields frame(keyframes->items()[i], fmt::format("keyframe {}", i), problems);
        bool focused = hasFocus;
        CameraKey key = readKey(frame, base, focused);
        const bool hasFrame = frame.require("frame");
        frame.number("frame", key.frame);
        frame.finish();
        if (hasFrame && !keys.empty() && key.frame <= keys.back().frame)
            frame.problem(frame.where(), fmt::format("keyframe {} is not later than the one before", i));
        if (!keys.empty() && (key.height > 0) != (keys.back().height > 0))
            frame.problem(frame.where(), fmt::format("of keyframes {} and {} only one is orthographic", i - 1, i));
        keys.push_back(key);
    }
    scene.camera.keys = std::move(keys);
}

}  // namespace lodestir
