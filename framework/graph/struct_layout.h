// SPDX-License-Identifier: MIT
// Where the fields of a shared struct lie: read from the text of its header, so that a dump can name them.
#pragma once
#include <framework/core/api.h>
#include <framework/core/files.h>

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace lodestir {

/// One member of a struct, or (with an empty name) a built-in type that stands for itself.
struct StructField {
    std::string name;
    std::string type;                  ///< GLSL name: "float", "vec3", "mat4" (columns), "uint64_t"; of a struct its own
    std::size_t offset = 0;            ///< bytes from the start of the struct it stands in
    std::size_t count = 0;             ///< elements of an array, 0: no array
    std::size_t size = 0;              ///< bytes of one element
    std::vector<StructField> members;  ///< of a struct
};

/// A built-in type as numbers: `rows` of `columns` scalars, one after the other (a matrix column by column).
/// rows is 1 for what is no matrix.
struct NumberType {
    char kind = 0;          ///< 'f', 'i', 'u'
    std::size_t bytes = 0;  ///< of a scalar
    std::size_t rows = 1, columns = 1;
};
/// kind is 0 for a name that is no built-in type.
LODESTIR_API NumberType numberType(std::string_view name);

/// The fields of struct `name` in scalar layout, which is the layout of the same struct in C++. `header` is the file, or the name by which
/// shaders include it, looked up in `folders`; the structs of what it includes may be nested. An empty header asks for a built-in type: one
/// nameless field. Members that are addresses (LODESTIR_ADDRESS and its like) count as uint64_t.
/// Error when the header can't be read, the struct isn't there, a member is of an unknown type, an array's length is neither a number nor
/// a constant of the headers, or the fields don't make up `expectedSize` bytes.
LODESTIR_API std::vector<StructField> structFields(std::string_view name, const Path& header, const std::vector<Path>& folders,
                                                   std::size_t expectedSize);

}  // namespace lodestir
