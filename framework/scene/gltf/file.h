// SPDX-License-Identifier: MIT
// A glTF 2.0 file taken apart: its structure (tinygltf), its buffers (bytes), and where each value is written.
#pragma once
#include <framework/core/files.h>
#include <framework/core/json.h>

#include <tiny_gltf.h>

#include <string>
#include <vector>

namespace lodestir {

/// tinygltf gets the JSON without buffers and images and touches no file: it would refuse buffers that are longer than
/// they say, and images that nothing uses. Bytes of `buffers` are read by Accessor and bufferViewBytes alone.
struct GltfFile {
    Path path;
    Json json;              ///< for places, buffers and images
    bool binary = false;    ///< a GLB: places inside its JSON mean nothing to people
    tinygltf::Model model;  ///< all but buffers and images
    std::vector<std::vector<std::byte>> buffers;
    std::vector<std::string> notes;  ///< what of its structure was left out

    /// Error at the value that a JSON pointer names ("/meshes/0/primitives/1"), or at the deepest part of it that exists.
    /// The pointer is part of the text.
    Error error(const std::string& pointer, const std::string& what, const std::string& hint = {}) const;
    /// The same for what went wrong in another file that this value names.
    Error error(const std::string& pointer, const Error& cause) const;
};

/// Reads a .gltf or .glb file (told apart by content). Error when it is no glTF 2.0, when it needs an extension that is not
/// supported (all of those named), or when a buffer is missing, short or malformed.
GltfFile readGltfFile(const Path& path);

/// Extensions that change what is loaded; anything else in extensionsUsed is ignored with a note, in extensionsRequired an error.
bool isSupportedGltfExtension(std::string_view name);

}  // namespace lodestir
