// SPDX-License-Identifier: MIT
#include <framework/app/view/told_paths.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace lodestir {
namespace {

using OrderedJson = nlohmann::ordered_json;

const OrderedJson* member(const OrderedJson& value, const char* key) {
    const auto found = value.is_object() ? value.find(key) : value.end();
    return found == value.end() ? nullptr : &*found;
}

bool isVector(const OrderedJson* value, std::size_t length) {
    return value && value->is_array() && value->size() == length && (*value)[0].is_number();
}

std::string pixelText(const OrderedJson& pixel) { return fmt::format("({}, {})", pixel[0].dump(), pixel[1].dump()); }

std::vector<glm::vec3> positionsOf(const OrderedJson& vertices) {
    std::vector<glm::vec3> positions;
    for (const OrderedJson& vertex : vertices) {
        const OrderedJson* position = member(vertex, "position");
        if (isVector(position, 3)) positions.emplace_back((*position)[0].get<float>(), (*position)[1].get<float>(), (*position)[2].get<float>());
    }
    return positions;
}

/// "trees" of which this is one -> "tree", with what tells it from the others.
std::string nameOf(const OrderedJson& path, std::string list) {
    if (list.ends_with("s")) list.pop_back();
    if (const OrderedJson* way = member(path, "way"); way && way->is_string()) list += " " + way->get<std::string>();
    const OrderedJson *from = member(path, "from"), *to = member(path, "to");
    if (isVector(from, 2) && isVector(to, 2)) list += " " + pixelText(*from) + " -> " + pixelText(*to);
    return list;
}

/// The reason of a failure wherever it was told; what the Jacobian is, and whether the path was taken.
void judge(const OrderedJson& path, ToldPath& told) {
    const auto reason = [&](const OrderedJson& place) {
        for (const char* why : {"failed", "hidden", "black", "none"})
            if (const OrderedJson* text = member(place, why); text && text->is_string()) {
                told.text = (why == std::string_view("hidden") ? "hidden: " : "") + text->get<std::string>();
                told.failed = true;
            }
    };
    if (const OrderedJson* jacobian = member(path, "jacobian"); jacobian && jacobian->is_number()) {
        told.text = fmt::format("J {:.4g}", jacobian->get<double>());
        told.failed = jacobian->get<double>() == 0;
    }
    if (const OrderedJson* candidate = member(path, "candidate")) {
        const OrderedJson *m = member(*candidate, "m"), *taken = member(*candidate, "taken");
        if (m && m->is_number()) told.text += fmt::format(", m {:.3g}", m->get<double>());
        if (taken && taken->is_boolean() && taken->get<bool>()) told.text += ", taken";
    }
    for (const OrderedJson& vertex : path["vertices"]) reason(vertex);
    reason(path);
}

void collect(const OrderedJson& value, const std::string& pass, const std::string& list, std::vector<ToldPath>& paths) {
    if (const OrderedJson* vertices = member(value, "vertices"); vertices && vertices->is_array()) {
        ToldPath told{.pass = pass, .name = nameOf(value, list), .vertices = positionsOf(*vertices)};
        judge(value, told);
        if (!told.vertices.empty()) paths.push_back(std::move(told));
    }
    if (value.is_object())
        for (const auto& [key, inner] : value.items()) collect(inner, pass, key, paths);
    if (value.is_array())
        for (const OrderedJson& inner : value) collect(inner, pass, list, paths);
}

}  // namespace

std::vector<ToldPath> pathsIn(const OrderedJson& passes) {
    std::vector<ToldPath> paths;
    for (const auto& [pass, told] : passes.items()) collect(told, pass, "", paths);
    return paths;
}

}  // namespace lodestir
