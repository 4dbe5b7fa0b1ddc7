// SPDX-License-Identifier: MIT
// Unit vectors in 32 bits and colours in 64: what framework/shaders/base/pack.glsl reads. The layouts are written there.
#pragma once
#include <glm/glm.hpp>

#include <algorithm>
#include <cstdint>

namespace lodestir {

inline constexpr std::uint32_t tangentNone = 0;

/// Octahedral, snorm16 x 2. Any length; a vector without direction packs as +Z.
inline std::uint32_t packNormal(glm::vec3 n) {
    const float size = glm::abs(n.x) + glm::abs(n.y) + glm::abs(n.z);
    if (!(size > 0) || glm::isinf(size)) return 0;
    n /= size;
    glm::vec2 p(n.x, n.y);
    if (n.z < 0) p = {(1 - glm::abs(n.y)) * (n.x >= 0 ? 1.0f : -1.0f), (1 - glm::abs(n.x)) * (n.y >= 0 ? 1.0f : -1.0f)};
    const glm::ivec2 q(glm::floor(glm::clamp(p, -1.0f, 1.0f) * 32767.0f + 0.5f));
    return (std::uint32_t(q.x) & 0xffffu) | std::uint32_t(q.y) << 16;
}

inline glm::vec3 unpackNormal(std::uint32_t bits) {
    const glm::vec2 p = glm::max(glm::vec2(std::int16_t(bits), std::int16_t(bits >> 16)) / 32767.0f, -1.0f);
    glm::vec3 n(p, 1 - glm::abs(p.x) - glm::abs(p.y));
    const float fold = glm::max(-n.z, 0.0f);
    n.x += n.x >= 0 ? -fold : fold;
    n.y += n.y >= 0 ? -fold : fold;
    return glm::normalize(n);
}

/// xyz: direction, w: sign of the bitangent cross(normal, tangent).
inline std::uint32_t packTangent(glm::vec4 tangent) {
    const std::uint32_t bits = (packNormal(glm::vec3(tangent)) & ~1u) | (tangent.w < 0 ? 1u : 0u);
    return bits == tangentNone ? 0x00010000u : bits;
}

inline glm::vec4 unpackTangent(std::uint32_t bits) { return {unpackNormal(bits & ~1u), (bits & 1u) ? -1.0f : 1.0f}; }

/// Half floats: 11 bits of relative precision from 6e-5 to 65504, where linear colours of 8 bits have none left in the dark. What is larger
/// becomes 65504, what is negative or no number 0.
inline glm::uvec2 packColor(glm::vec4 color) {
    constexpr float largest = 65504;
    for (int i = 0; i < 4; ++i) color[i] = color[i] > 0 ? std::min(color[i], largest) : 0;
    return {glm::packHalf2x16(glm::vec2(color)), glm::packHalf2x16(glm::vec2(color.z, color.w))};
}

}  // namespace lodestir
