// SPDX-License-Identifier: MIT
// Buffers as NumPy arrays: numpy.load(file)["field"] in scripts.
#pragma once
#include <framework/core/api.h>
#include <framework/core/files.h>
#include <framework/graph/struct_layout.h>

#include <cstddef>
#include <span>

namespace lodestir {

/// Writes elements of a struct as an .npy file (format 1.0, or 2.0 where the header is long; little-endian, C order) with a structured
/// dtype: one field a member, vectors as sub-arrays, matrices as sub-arrays of columns, nested structs nested, gaps kept. A single nameless
/// field (a built-in type) gives a plain dtype; its vector or matrix adds axes at the end of `shape`.
/// `bytes` holds the product of `shape` elements, the last axis fastest. Written aside, then renamed.
/// Error when the sizes don't fit, or the file cannot be written.
LODESTIR_API void writeNpy(const Path& path, std::span<const std::byte> bytes, std::span<const StructField> fields,
                           std::span<const std::size_t> shape);

}  // namespace lodestir
