// SPDX-License-Identifier: MIT
// Keeps built hierarchies on disk by the content they were built from.
#include <framework/core/error.h>
#include <framework/core/files.h>
#include <framework/core/log.h>
#include <framework/scene/bvh/bvh.h>

#include <cstring>
#include <optional>

namespace lodestir {
namespace {

constexpr std::string_view version = "lodestir bvh 3";  // of the builder and the file: change it when either changes
constexpr std::size_t worthwhile = 16384;               // triangles: below, building is as fast as reading

struct Header {
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

template <class T> void append(std::vector<std::byte>& out, std::span<const T> values) {
    const auto bytes = std::as_bytes(values);
    out.insert(out.end(), bytes.begin(), bytes.end());
}

/// Moves the first `count` values of the bytes into a vector and drops them from the bytes.
template <class T> std::vector<T> take(std::span<const std::byte>& bytes, std::size_t count) {
    std::vector<T> values(count);
    std::memcpy(values.data(), bytes.data(), count * sizeof(T));
    bytes = bytes.subspan(count * sizeof(T));
    return values;
}

void writeBvh(const Path& path, const Bvh& bvh) {
    Header header{.gridBase = bvh.gridBase, .gridScale = bvh.gridScale, .root = bvh.root, .nodes = std::uint32_t(bvh.nodes.size()),
                  .triangles = std::uint32_t(bvh.triangles.size())};
    std::vector<std::byte> bytes(sizeof header);
    append(bytes, std::span(bvh.nodes));
    append(bytes, std::span(bvh.triangles));
    append(bytes, std::span(bvh.order));
    std::memcpy(bytes.data(), &header, sizeof header);
    writeSealed(path, bytes);
}

std::optional<Bvh> readBvh(const Path& path) {
    const std::optional<std::vector<std::byte>> file = readSealed(path);  // a damaged one would send rays anywhere
    if (!file) return {};
    std::span<const std::byte> bytes = *file;
    Header header;
    if (bytes.size() < sizeof header) return {};
    std::memcpy(&header, bytes.data(), sizeof header);
    const std::size_t triangleBytes = sizeof(BvhTriangle) + sizeof(std::uint32_t);
    if (bytes.size() != sizeof header + header.nodes * sizeof(BvhNode) + header.triangles * triangleBytes) return {};
    bytes = bytes.subspan(sizeof header);
    Bvh bvh{.gridBase = header.gridBase, .gridScale = header.gridScale, .root = header.root};
    bvh.nodes = take<BvhNode>(bytes, header.nodes);
    bvh.triangles = take<BvhTriangle>(bytes, header.triangles);
    bvh.order = take<std::uint32_t>(bytes, header.triangles);
    return bvh;
}

}  // namespace

Bvh cachedBvh(const BvhInput& input) {
    if (input.triangles.size() < worthwhile) return buildBvh(input);
    const Path path = cacheFolder("bvh") / (keyOf(input).hex() + ".bvh");
    if (std::optional<Bvh> bvh = readBvh(path)) return std::move(*bvh);
    Bvh bvh = buildBvh(input);
    try {
        writeBvh(path, bvh);
    } catch (const Error& error) {
        log::warn("the BVH cache can't be written: {}", error.what());
    }
    return bvh;
}

}  // namespace lodestir
