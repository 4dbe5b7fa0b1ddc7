// SPDX-License-Identifier: MIT
#include <framework/scene/gltf/structure.h>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>

namespace lodestir {
namespace {

/// tinygltf must neither read files nor decode images: it is given none, and these make sure of it.
void forbidFiles(tinygltf::TinyGLTF& parser) {
    parser.SetFsCallbacks({
        [](const std::string&, void*) { return false; },
        [](const std::string& path, void*) { return path; },
        [](std::vector<unsigned char>*, std::string*, const std::string&, void*) { return false; },
        [](std::string*, const std::string&, const std::vector<unsigned char>&, void*) { return false; },
        nullptr,
    });
}

/// tinygltf refuses a whole file for whole numbers written as 4.0, and for two things that are harmless until they are used: indices
/// without data, and accessors of a type that it doesn't know. It is shown others in their place, which are taken out of the model afterwards.
class Harmless {
public:
    explicit Harmless(nlohmann::ordered_json& structure) {
        shortenNumbers(structure);
        if (!structure.contains("accessors") || !structure["accessors"].is_array()) return;
        const std::size_t views = structure.contains("bufferViews") ? structure["bufferViews"].size() : 0;
        auto& accessors = structure["accessors"];
        static const std::set<std::string> known{"SCALAR", "VEC2", "VEC3", "VEC4", "MAT2", "MAT3", "MAT4"};
        for (std::size_t i = 0; i < accessors.size(); ++i) {
            if (!accessors[i].is_object() || !accessors[i].contains("type") || !accessors[i]["type"].is_string()) continue;
            if (known.contains(accessors[i]["type"].get<std::string>())) continue;
            accessors[i]["type"] = "SCALAR";
            unknown_.push_back(i);
        }
        for (const std::size_t i : indicesOf(structure, accessors.size())) {
            if (!accessors[i].is_object() || accessors[i].contains("bufferView")) continue;
            accessors[i]["bufferView"] = views;
            bare_.push_back(i);
        }
        if (!bare_.empty()) structure["bufferViews"].push_back({{"buffer", 0}, {"byteLength", 1}});
    }

    void takeOut(tinygltf::Model& model) const {
        for (const std::size_t i : unknown_) model.accessors[i].type = -1;
        for (const std::size_t i : bare_) model.accessors[i].bufferView = -1;
        if (!bare_.empty()) model.bufferViews.pop_back();
    }

private:
    static void shortenNumbers(nlohmann::ordered_json& value) {
        constexpr double exact = 1ll << 53;
        if (value.is_structured()) {
            for (auto& child : value) shortenNumbers(child);
        } else if (value.is_number_float()) {
            const double number = value.get<double>();
            if (std::abs(number) < exact && number == std::floor(number)) value = static_cast<std::int64_t>(number);
        }
    }

    /// Accessors that primitives have as their indices.
    static std::set<std::size_t> indicesOf(const nlohmann::ordered_json& structure, std::size_t accessorCount) {
        std::set<std::size_t> found;
        const auto views = structure.find("bufferViews");
        if (!structure.contains("meshes") || (views != structure.end() && !views->is_array())) return found;
        for (const auto& mesh : structure["meshes"]) {
            if (!mesh.is_object() || !mesh.contains("primitives")) continue;
            for (const auto& primitive : mesh["primitives"]) {
                if (!primitive.is_object() || !primitive.contains("indices") || !primitive["indices"].is_number_integer()) continue;
                const auto i = primitive["indices"].get<std::int64_t>();
                if (i >= 0 && std::uint64_t(i) < accessorCount) found.insert(std::size_t(i));
            }
        }
        return found;
    }

    std::vector<std::size_t> unknown_, bare_;
};

/// Each object of an array of the structure, if there is one.
template <class Change> void forEach(nlohmann::ordered_json& owner, const char* key, const Change& change) {
    if (!owner.is_object() || !owner.contains(key) || !owner[key].is_array()) return;
    for (auto& item : owner[key])
        if (item.is_object()) change(item);
}

nlohmann::ordered_json* objectIn(nlohmann::ordered_json& owner, const char* key) {
    const auto found = owner.find(key);
    return found != owner.end() && found->is_object() ? &*found : nullptr;
}

/// Small things for which tinygltf refuses a file or drops the rest of a material. What is missing becomes what the format says without it.
void mend(GltfFile& file, nlohmann::ordered_json& structure) {
    const auto setLength = [&](nlohmann::ordered_json& owner, const char* key, std::size_t length) {
        const auto color = owner.find(key);
        if (color == owner.end() || !color->is_array() || color->size() == length) return;
        file.notes.push_back(fmt::format("{} has {} numbers, not {}; those it lacks are 1", key, color->size(), length));
        while (color->size() < length) color->push_back(1);
        while (color->size() > length) color->erase(color->size() - 1);
    };
    forEach(structure, "materials", [&](nlohmann::ordered_json& material) {
        setLength(material, "emissiveFactor", 3);
        if (nlohmann::ordered_json* pbr = objectIn(material, "pbrMetallicRoughness")) setLength(*pbr, "baseColorFactor", 4);
    });
    forEach(structure, "cameras", [](nlohmann::ordered_json& camera) {
        nlohmann::ordered_json* perspective = objectIn(camera, "perspective");
        if (perspective && !perspective->contains("znear")) (*perspective)["znear"] = 0;  // nothing here is nearer than the lens
    });
    nlohmann::ordered_json* extensions = objectIn(structure, "extensions");
    nlohmann::ordered_json* punctual = extensions ? objectIn(*extensions, "KHR_lights_punctual") : nullptr;
    if (!punctual) return;
    forEach(*punctual, "lights", [](nlohmann::ordered_json& light) {
        if (light.value("type", nlohmann::ordered_json()) == "spot" && !light.contains("spot"))
            light["spot"] = nlohmann::ordered_json::object();
    });
}

/// Parts of a file that its meshes can be shown without.
constexpr std::array<const char*, 4> dispensable{"animations", "cameras", "skins", "lights"};

void removePart(nlohmann::ordered_json& structure, const char* part) {
    structure.erase(part);
    if (const auto extensions = structure.find("extensions");
        extensions != structure.end() && extensions->is_object() && part == std::string_view("lights"))
        extensions->erase("KHR_lights_punctual");
}

/// What tinygltf finds wrong; nothing where it makes `model` of the structure.
std::optional<std::string> parse(const nlohmann::ordered_json& structure, tinygltf::Model& model) {
    const std::string text = structure.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
    tinygltf::TinyGLTF parser;
    forbidFiles(parser);
    std::string errors, warnings;
    bool good = false;
    model = {};
    try {
        good = parser.LoadASCIIFromString(&model, &errors, &warnings, text.data(), static_cast<unsigned>(text.size()), {});
    } catch (const std::exception& thrown) {
        errors = thrown.what();
    }
    if (good) return {};
    std::replace(errors.begin(), errors.end(), '\n', ' ');
    while (errors.ends_with(' ')) errors.pop_back();
    return errors.empty() ? "its structure is not as the format demands" : errors;
}

}  // namespace

void parseGltfStructure(GltfFile& file) {
    Json source = file.json;
    source.remove("buffers");
    source.remove("images");
    nlohmann::ordered_json structure = source.plain();
    mend(file, structure);
    const Harmless harmless(structure);
    std::optional<std::string> wrong = parse(structure, file.model);
    const std::string first = wrong.value_or("");
    std::vector<const char*> removed;
    for (std::size_t i = 0; i < dispensable.size() && wrong; ++i) {  // which of them is wrong, if it is one alone
        nlohmann::ordered_json rest = structure;
        removePart(rest, dispensable[i]);
        removed = {dispensable[i]};
        wrong = rest == structure ? first : parse(rest, file.model);
    }
    if (wrong) {
        removed.assign(dispensable.begin(), dispensable.end());
        for (const char* part : removed) removePart(structure, part);
        wrong = parse(structure, file.model);
    }
    if (wrong) throw Error(Where{file.path.string()}, "not valid glTF: " + first);
    if (!removed.empty())
        file.notes.push_back(fmt::format("its {} are left out, which are not as the format demands: {}", fmt::join(removed, ", "), first));
    harmless.takeOut(file.model);
}

}  // namespace lodestir
