// SPDX-License-Identifier: MIT
// GLSL -> SPIR-V in process (glslang), with the closure of includes known and the result kept on disk by content.
#pragma once
#include <framework/core/files.h>

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace lodestir::gpu {

struct ShaderSource {
    Path file;                                     ///< the entry point, a .comp
    std::vector<Path> folders;                     ///< where #include "x" is looked up after the including file's own folder
    std::map<std::string, std::string> generated;  ///< include name -> text, for files that exist in memory only ("pass.glsl")
    std::vector<std::pair<std::string, std::string>> defines;
    bool texelReads = false;                       ///< arrays are read by texel rather than by address (gpu/texel_reads.h)
};

struct Spirv {
    std::vector<std::uint32_t> words;
    std::vector<Path> files;  ///< the entry point and everything it includes, for watching
    Hash hash;                ///< of the preprocessed input: same hash, same words
    bool cached = false;
};

/// Compiles for Vulkan 1.3 / SPIR-V 1.6. Every include is read once (as if all had #pragma once). Error lists glslang's messages
/// as file:line: message with the source line shown.
LODESTIR_API Spirv compileShader(const ShaderSource& source);
/// Hash of a header and all that it includes, comments kept: the identity of a struct shared by C++ and GLSL.
LODESTIR_API Hash includeClosure(const Path& file, const std::vector<Path>& folders);

}  // namespace lodestir::gpu
