// SPDX-License-Identifier: MIT
// Notes, problems and the reading of extension objects.
#include <framework/scene/gltf/import.h>

#include <fmt/format.h>

#include <cmath>

namespace lodestir {

void GltfImport::note(const std::string& text) {
    if (noted.insert(text).second) scene.notes.push_back(file.path.filename().string() + ": " + text);
}

void GltfImport::noteLeftOut(const std::string& what, const Error& cause) {
    const Problem& problem = cause.problems().front();
    const bool isElsewhere = !problem.where.file.empty() && problem.where.file != file.path.string();
    note(fmt::format("{} is left out: {}{}{}", what, isElsewhere ? problem.where.file + ": " : "", problem.what,
                     problem.hint.empty() ? "" : "; " + problem.hint));
}

void GltfImport::problem(const std::string& pointer, const std::string& what, const std::string& hint) {
    problems.add(file.error(pointer, what, hint));
}

const tinygltf::Value* findExtension(const tinygltf::ExtensionMap& extensions, const char* name) {
    const auto found = extensions.find(name);
    return found != extensions.end() && found->second.IsObject() ? &found->second : nullptr;
}

float numberOf(const tinygltf::Value* object, const char* key, float otherwise) {
    if (!object || !object->Has(key) || !object->Get(key).IsNumber()) return otherwise;
    const auto value = static_cast<float>(object->Get(key).GetNumberAsDouble());
    return std::isfinite(value) ? value : otherwise;
}

int integerOf(const tinygltf::Value* object, const char* key, int otherwise) {
    return object && object->Has(key) && object->Get(key).IsInt() ? object->Get(key).GetNumberAsInt() : otherwise;
}

glm::vec3 vectorOf(const tinygltf::Value* object, const char* key, glm::vec3 otherwise) {
    if (!object || !object->Has(key)) return otherwise;
    const tinygltf::Value& array = object->Get(key);
    if (array.ArrayLen() < 3) return otherwise;
    glm::vec3 result = otherwise;
    for (int i = 0; i < 3; ++i) {
        if (!array.Get(i).IsNumber()) return otherwise;
        result[i] = static_cast<float>(array.Get(i).GetNumberAsDouble());
        if (!std::isfinite(result[i])) return otherwise;
    }
    return result;
}

}  // namespace lodestir
