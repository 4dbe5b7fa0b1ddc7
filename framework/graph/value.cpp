// SPDX-License-Identifier: MIT
// Parameter values: from JSON with checks, back to JSON, and set later by name.
#include <framework/core/is_file.h>
#include <framework/graph/graph.h>

#include <fmt/format.h>

#include <cstdlib>

namespace lodestir {
namespace {

std::string describe(const Parameter& p) {
    return fmt::format("{}, default {}: {}", p.typeText(), writeValue(p, p.initial).dump(-1), p.doc);
}

template <class T, class N> T within(const Parameter& p, const Json& value, const std::string& what, N number) {
    if (number >= static_cast<N>(std::get<T>(p.low)) && number <= static_cast<N>(std::get<T>(p.high))) return static_cast<T>(number);
    throw Error(value.where(), fmt::format("{} must be {}..{}, not {}", what, std::get<T>(p.low), std::get<T>(p.high), value.dump(-1)),
                describe(p));
}

int readChoice(const Parameter& p, const Json& value, const std::string& what) {
    const std::string& name = value.asString(what);
    for (std::size_t i = 0; i < p.choices.size(); ++i) {
        if (p.choices[i] == name) return static_cast<int>(i);
    }
    const std::vector<std::string> known(p.choices.begin(), p.choices.end());
    throw Error(value.where(), fmt::format("{} can't be \"{}\"", what, name), didYouMean(name, known));
}

/// Relative to the folder of the file that names it, or to the working folder where no file does.
std::string readFile(const Json& value, const std::string& what) {
    const std::string named = value.asString(what);
    if (named.empty()) return {};
    const Path by = value.where().file;
    const Path base = isFile(by) ? by.parent_path() : Path();
    const Path whole = std::filesystem::absolute(namedPath(base, named)).lexically_normal();
    if (!isFile(whole)) throw Error(value.where(), fmt::format("{}: there is no file {}", what, whole.string()));
    return whole.string();
}

}  // namespace

Value readValue(const Parameter& p, const Json& value, std::string_view owner) {
    const std::string what = fmt::format("pass \"{}\": \"{}\"", owner, p.name);
    if (p.isChoice()) return readChoice(p, value, what);
    if (std::holds_alternative<bool>(p.initial)) return value.asBool(what);
    if (std::holds_alternative<int>(p.initial)) return within<int>(p, value, what, value.asInt(what));
    if (std::holds_alternative<float>(p.initial)) {
        // As a float: 0.1 written in a file is the 0.1f that a pass gives as its limit.
        return within<float>(p, value, what, static_cast<float>(value.asNumber(what)));
    }
    return p.isFile ? readFile(value, what) : value.asString(what);
}

Json writeValue(const Parameter& p, const Value& value) {
    if (p.isChoice()) return Json(std::string(p.choices.at(static_cast<std::size_t>(std::get<int>(value)))));
    if (const bool* flag = std::get_if<bool>(&value)) return Json(*flag);
    if (const int* number = std::get_if<int>(&value)) return Json(*number);
    if (const float* number = std::get_if<float>(&value)) return Json(std::strtod(fmt::format("{}", *number).c_str(), nullptr));
    return Json(std::get<std::string>(value));
}

bool setParameter(Graph& graph, const std::string& name, const Json& value) {
    const std::size_t dot = name.find('.');
    const std::string nodeName = name.substr(0, dot), parameterName = dot == name.npos ? std::string() : name.substr(dot + 1);
    const int index = graph.find(nodeName);
    if (index < 0) {
        std::vector<std::string> names;
        for (const GraphNode& node : graph.nodes) names.push_back(node.name);
        throw Error(value.where(), "no pass \"" + nodeName + "\"", didYouMean(nodeName, names));
    }
    const GraphNode& node = graph.nodes[static_cast<std::size_t>(index)];
    std::vector<std::string> names;
    for (Parameter* parameter : node.pass->parameters) {
        names.emplace_back(parameter->name);
        if (parameter->name != parameterName) continue;
        Value next = readValue(*parameter, value, node.name);
        if (next == parameter->value) return false;
        parameter->value = std::move(next);
        return true;
    }
    throw Error(value.keyWhere(), fmt::format("pass \"{}\": no parameter \"{}\" on {}", node.name, parameterName, node.type),
                names.empty() ? "it has none" : didYouMean(parameterName, names));
}

}  // namespace lodestir
