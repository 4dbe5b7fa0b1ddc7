// SPDX-License-Identifier: MIT
// Keeps built hierarchies on disk by the content they were built from.
#include <framework/core/error.h>
#include <framework/core/file_parts.h>
#include <framework/core/is_file.h>
#include <framework/core/log.h>
#include <framework/scene/bvh/bvh.h>

#include <array>
#include <optional>

namespace lodestir {
namespace {

constexpr std::string_view version = "lodestir bvh 3";  // of the builder and the file: change it when either changes
constexpr std::size_t worthwhile = 16384;               // triangles: below, building is as fast as reading

struct Header {
    Hash content;  ///< of what follows: a damaged file would send rays anywhere
    glm::vec3 gridBase, gridScale;
    std::uint32_t root;
    std::uint32_t nodes, triangles;
};

Hash keyOf(const BvhInput& input) {
    Hash hash;
    hash.add(version).addValue(input.positions.size()).addValue(input.triangles.size()).addValue(input.masks.size());
    hash.add(std::as_bytes(input.positions)).add(std::as_bytes(input.triangles)).add(std::as_bytes(input.masks)).addValue(input.grid);
    return hash;
}

Hash contentOf(const Header& header, const Bvh& bvh) {
    Hash hash;
    hash.addValue(header.gridBase).addValue(header.gridScale).addValue(header.root);
    return hash.add(std::as_bytes(std::span(bvh.nodes))).add(std::as_bytes(std::span(bvh.order)));
}

void writeBvh(const Path& path, const Bvh& bvh) {
    Header header{.gridBase = bvh.gridBase, .gridScale = bvh.gridScale, .root = bvh.root, .nodes = std::uint32_t(bvh.nodes.size()),
                  .triangles = std::uint32_t(bvh.order.size())};
    header.content = contentOf(header, bvh);
    const std::array parts{std::as_bytes(std::span(&header, 1)), std::as_bytes(std::span(bvh.nodes)), std::as_bytes(std::span(bvh.order))};
    writeParts(path, parts);
}

std::optional<Bvh> readBvh(const Path& path) {
    if (!isFile(path)) return {};
    FileReader file(path);
    Header header;
    if (!file.read(std::as_writable_bytes(std::span(&header, 1)))) return {};
    if (file.size() != sizeof header + header.nodes * sizeof(BvhNode) + header.triangles * sizeof(std::uint32_t)) return {};
    Bvh bvh{.gridBase = header.gridBase, .gridScale = header.gridScale, .root = header.root};
    bvh.nodes.resize(header.nodes);
    bvh.order.resize(header.triangles);
    const bool whole = file.read(std::as_writable_bytes(std::span(bvh.nodes))) && file.read(std::as_writable_bytes(std::span(bvh.order)));
    if (!whole || header.content != contentOf(header, bvh)) return {};
    return bvh;
}

}  // namespace

Bvh cachedBvh(const BvhInput& input) {
    if (input.triangles.size() < worthwhile) return buildBvh(input);
    const Path path = cacheFolder("bvh") / (keyOf(input).hex() + ".bvh");
    try {
        if (std::optional<Bvh> bvh = readBvh(path)) return std::move(*bvh);
    } catch (const Error&) {
        // Unreadable is as good as missing.
    }
    Bvh bvh = buildBvh(input);
    try {
        writeBvh(path, bvh);
    } catch (const Error& error) {
        log::warn("the BVH cache can't be written: {}", error.what());
    }
    return bvh;
}

}  // namespace lodestir
