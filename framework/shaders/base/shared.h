// SPDX-License-Identifier: MIT
// Lets one header be compiled as C++ and as GLSL (scalar layout), so that a struct is typed once.
#ifndef LODESTIR_SHARED_H
#define LODESTIR_SHARED_H

#ifdef __cplusplus
#include <glm/glm.hpp>

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace lodestir {

using glm::ivec2;
using glm::ivec3;
using glm::ivec4;
using glm::uvec2;
using glm::uvec3;
using glm::uvec4;
using glm::vec2;
using glm::vec3;
using glm::vec4;
using uint = std::uint32_t;
using uint64_t = std::uint64_t;

/// Name, size and header of a struct that C++ and GLSL share; specialised by LODESTIR_SHARED.
template <class T> struct SharedStruct;
#define LODESTIR_SHARED_SIMPLE(T)                                 \
    template <> struct SharedStruct<T> {                          \
        static constexpr std::string_view name = #T, header = ""; \
        static constexpr std::size_t size = sizeof(T);            \
    };
LODESTIR_SHARED_SIMPLE(float)
LODESTIR_SHARED_SIMPLE(int)
LODESTIR_SHARED_SIMPLE(uint)
LODESTIR_SHARED_SIMPLE(vec2)
LODESTIR_SHARED_SIMPLE(vec3)
LODESTIR_SHARED_SIMPLE(vec4)
LODESTIR_SHARED_SIMPLE(uvec2)
LODESTIR_SHARED_SIMPLE(uvec4)
#undef LODESTIR_SHARED_SIMPLE

}  // namespace lodestir

#define LODESTIR_SHARED_BEGIN namespace lodestir {
#define LODESTIR_SHARED_END }
/// Outside the namespace block: announces struct T of header `path` (as it is included in GLSL).
#define LODESTIR_SHARED(T, path)                                     \
    template <> struct lodestir::SharedStruct<lodestir::T> {         \
        static constexpr std::string_view name = #T, header = path;  \
        static constexpr std::size_t size = sizeof(lodestir::T);     \
    };
#define LODESTIR_ADDRESS(T) uint64_t

#else

#define LODESTIR_SHARED_BEGIN
#define LODESTIR_SHARED_END
#define LODESTIR_SHARED(T, path)
#define LODESTIR_ADDRESS(T) uint64_t

#endif
#endif
