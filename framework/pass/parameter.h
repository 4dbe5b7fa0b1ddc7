// SPDX-License-Identifier: MIT
// What can be set on a pass. The member is the declaration and the storage: name, default, range and sentence are typed once.
#pragma once
#include <framework/core/api.h>

#include <filesystem>
#include <initializer_list>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

namespace lodestir {

class Pass;

/// bool, int (also the index of a choice), float, or text (also the path of a file; never seen by shaders).
using Value = std::variant<bool, int, float, std::string>;

struct LODESTIR_API Parameter {
    std::string_view name, doc;
    Value value, initial, low, high;         ///< low and high: for int and float
    std::vector<std::string_view> choices;   ///< names of an enum's values, else empty
    bool constant;                           ///< a specialization constant: only for array sizes and loop shapes
    bool isFile = false;                     ///< the path of a file that the pass reads: has to be there, relative to the graph file

    bool isChoice() const { return !choices.empty(); }
    std::string typeText() const;            ///< "bool", "int 1..16", "float 0..10", "nee | bsdf | both", "text", "file"

protected:
    /// Enters the parameter into the pass's list.
    Parameter(Pass* pass, std::string_view name, std::string_view doc, Value initial, Value low, Value high, bool constant,
              std::vector<std::string_view> choices = {});
};

template <class T> struct Range {
    T low, high;
};

/// A uniform: changing it costs nothing. T is bool, int, float, std::string, std::filesystem::path, or an enum whose values count from 0.
template <class T, bool C = false> struct Param : Parameter {
    static_assert(std::is_same_v<T, int> || std::is_same_v<T, float>, "bool, int, float, std::string or an enum");
    Param(Pass* pass, std::string_view n, T initialValue, Range<T> range, std::string_view d) : Parameter(pass, n, d, initialValue, range.low, range.high, C) {}
    operator T() const { return std::get<T>(value); }
};
template <bool C> struct Param<bool, C> : Parameter {
    Param(Pass* pass, std::string_view n, bool initialValue, std::string_view d) : Parameter(pass, n, d, initialValue, false, true, C) {}
    operator bool() const { return std::get<bool>(value); }
};
template <> struct Param<std::string, false> : Parameter {
    Param(Pass* pass, std::string_view n, std::string initialValue, std::string_view d) : Parameter(pass, n, d, initialValue, {}, {}, false) {}
    operator const std::string&() const { return std::get<std::string>(value); }
};
/// A file that the pass reads, whole path and all; empty where none was named.
template <> struct Param<std::filesystem::path, false> : Parameter {
    Param(Pass* pass, std::string_view n, std::string_view d) : Parameter(pass, n, d, std::string(), {}, {}, false) { isFile = true; }
    operator std::filesystem::path() const { return std::get<std::string>(value); }
};
template <class T, bool C>
    requires std::is_enum_v<T>
struct Param<T, C> : Parameter {
    Param(Pass* pass, std::string_view n, T initialValue, std::initializer_list<std::string_view> names, std::string_view d)
        : Parameter(pass, n, d, static_cast<int>(initialValue), 0, static_cast<int>(names.size()) - 1, C, names) {}
    operator T() const { return static_cast<T>(std::get<int>(value)); }
};

// What several passes share is a group, declared once: a struct with Params as members and a constructor that takes the pass. A member of the pass
// (`Similarity similarity{this};`) enters them all, under their own names; the GLSL that asks by them stands beside the group.

/// A specialization constant. On lavapipe every value is a new compilation.
template <class T> using Const = Param<T, true>;

}  // namespace lodestir
