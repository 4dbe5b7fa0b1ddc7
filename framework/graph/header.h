// SPDX-License-Identifier: MIT
// Writes pass.glsl, the shader's view of one pass instance, and the layout of the block that the runner fills for it.
#pragma once
#include <framework/graph/plan.h>

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace lodestir {

/// What the text of pass.glsl depends on beyond the declaration: is a port wired (an optional output: made), and in which format an image really is.
struct PortBinding {
    bool bound = true;
    Format format = Format::rgba32f;
};
/// One per port of the node's pass.
LODESTIR_API std::vector<PortBinding> bindingsOf(const Graph& graph, const Plan& plan, int node);

/// The text of pass.glsl. The first line of a shader is #include "pass.glsl".
LODESTIR_API std::string passHeader(const Pass& pass, std::string_view owner, std::span<const PortBinding> bindings);
inline std::string passHeader(const Graph& graph, const Plan& plan, int node) {
    const GraphNode& n = graph.nodes[static_cast<std::size_t>(node)];
    return passHeader(*n.pass, n.name + " (" + n.type + ")", bindingsOf(graph, plan, node));
}

/// Byte offsets in PassBlock (scalar layout): FrameInfo at 0, then one PortRecord a port, then the uniform parameters, 4 bytes each
/// (bool as 0 or 1, choices as int).
struct BlockLayout {
    std::size_t bytes = 0;
    std::vector<std::size_t> ports;                       ///< offset of each port's PortRecord
    std::vector<std::optional<std::size_t>> parameters;   ///< of each uniform parameter; constants and texts have none
    std::vector<std::optional<std::uint32_t>> constants;  ///< constant_id of each Const
};
LODESTIR_API BlockLayout blockLayout(const Pass& pass);
/// Writes the uniform parameters into a block of blockLayout(pass).bytes.
LODESTIR_API void writeParameters(const Pass& pass, const BlockLayout& layout, std::span<std::byte> block);
/// The 32 bits of a parameter as shaders see them (uniforms and specialization constants alike). Not for texts.
LODESTIR_API std::uint32_t bitsOf(const Parameter& parameter);

/// Workgroups (of 64 invocations) that a plain shader needs: 8x8 tiles, or rows of 64 where the extent is one pixel high.
LODESTIR_API glm::uvec2 groupCount(glm::uvec2 extent);

/// Checks a declaration: names that GLSL reserves or that pass.glsl uses itself, names given twice, sizes like ports that are not there,
/// defaults out of range, bypasses of different types. `type` names the pass in the messages.
LODESTIR_API void checkDeclaration(const Pass& pass, const std::string& type, const Where& where, Problems& problems);

}  // namespace lodestir
