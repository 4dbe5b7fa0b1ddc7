// SPDX-License-Identifier: MIT
#include <framework/graph/kernel_source.h>
#include <framework/scene/visit.h>
#include <framework/study/content.h>

#include <concepts>
#include <span>
#include <type_traits>

namespace lodestir {
namespace {

template <class T> struct IsList : std::false_type {};
template <class T> struct IsList<std::vector<T>> : std::true_type {};
template <class T, std::size_t N> struct IsList<std::array<T, N>> : std::true_type {};
template <class T> struct IsOptional : std::false_type {};
template <class T> struct IsOptional<std::optional<T>> : std::true_type {};

/// Names, notes and places of files, which tell people something; images are made of numbers.
template <class T> constexpr bool isText = std::same_as<T, std::string> || std::same_as<T, Path>;
/// Numbers, and glm's vectors, quaternions and matrices of them: bytes without padding.
template <class T> constexpr bool isPlain = std::is_arithmetic_v<T> || std::is_enum_v<T>;
template <class T>
    requires requires { typename T::value_type; T::length(); }
constexpr bool isPlain<T> = true;

/// Adds a value of a scene, whatever it is made of.
struct Adder {
    Hash& hash;

    template <class T> void operator()(const T& value) {
        if constexpr (isText<T>) {
        } else if constexpr (isPlain<T>) {
            hash.addValue(value);
        } else if constexpr (IsOptional<T>::value) {
            hash.addValue(value.has_value());
            if (value) (*this)(*value);
        } else if constexpr (IsList<T>::value) {
            using Element = typename T::value_type;
            if constexpr (isText<Element>) return;
            hash.addValue(value.size());
            if constexpr (isPlain<Element>) hash.add(std::as_bytes(std::span(value)));
            else for (const Element& element : value) (*this)(element);
        } else {
            visit(*this, value);
        }
    }
};

}  // namespace

Hash contentOf(const Graph& graph) {
    Hash hash;
    Json text = graph.resolved();
    text.remove("scene");
    text.remove("about");
    hash.add(text.dump(-1)).add(frameworkSources());
    hash.addValue(contentOf(shadersIn(shaderFolder() / "trace"), {shaderFolder()}));  // what the framework dispatches between passes
    for (const GraphNode& node : graph.nodes) {
        hash.addValue(node.code);
        if (node.plugin) hash.addValue(contentOf(shadersOf(*node.plugin), includeFolders(*node.plugin)));
        for (const Parameter* parameter : node.pass->parameters)
            if (const auto* file = std::get_if<std::string>(&parameter->value); parameter->isFile && !file->empty()) hash.add(readBytes(*file));
    }
    return hash;
}

Hash contentOf(const Scene& scene) {
    Hash hash;
    Adder{hash}(scene);
    return hash;
}

}  // namespace lodestir
