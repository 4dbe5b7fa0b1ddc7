// SPDX-License-Identifier: MIT
// Buffer views compressed by meshoptimizer: checked as the extensions' texts say, then decoded with the library.
#include <framework/scene/gltf/import.h>
#include <framework/scene/gltf/meshopt.h>
#include <framework/scene/gltf/meshopt_attributes.h>

#include <fmt/format.h>
#include <meshoptimizer.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <span>
#include <type_traits>

namespace lodestir {
namespace {

constexpr std::size_t largestView = std::size_t(1) << 31;

/// What a view says of its compressed data.
struct Compressed {
    std::span<const std::byte> bytes;
    std::size_t count = 0, stride = 0;
    std::string mode, filter;
};

std::string textOf(const tinygltf::Value& object, const char* key, const char* otherwise) {
    return object.Has(key) && object.Get(key).IsString() ? object.Get(key).Get<std::string>() : otherwise;
}

/// Error with what is wrong in it; `pointer` names the extension object.
Compressed readExtension(const GltfFile& file, const tinygltf::Value& object, const std::string& pointer) {
    const auto natural = [&](const char* key, int otherwise) {
        const int value = integerOf(&object, key, otherwise);
        if (value < 0) throw file.error(pointer, fmt::format("\"{}\" must be a number from 0 on", key));
        return static_cast<std::size_t>(value);
    };
    const std::size_t buffer = natural("buffer", -1), offset = natural("byteOffset", 0), length = natural("byteLength", -1);
    Compressed c{
        .count = natural("count", -1), .stride = natural("byteStride", -1), .mode = textOf(object, "mode", ""), .filter = textOf(object, "filter", "NONE")};
    if (buffer >= file.buffers.size()) throw file.error(pointer, fmt::format("there is no buffer {}, the file has {}", buffer, file.buffers.size()));
    const std::vector<std::byte>& from = file.buffers[buffer];
    if (offset > from.size() || length > from.size() - offset)
        throw file.error(pointer, fmt::format("bytes {} to {} are not all inside buffer {} of {} bytes", offset, offset + length, buffer, from.size()));
    c.bytes = std::span(from).subspan(offset, length);

    const bool attributes = c.mode == "ATTRIBUTES";
    if (!attributes && c.mode != "TRIANGLES" && c.mode != "INDICES")
        throw file.error(pointer, fmt::format("there is no mode \"{}\"", c.mode), "known: ATTRIBUTES, TRIANGLES, INDICES");
    const bool strideFits = attributes ? c.stride >= 4 && c.stride <= 256 && c.stride % 4 == 0 : c.stride == 2 || c.stride == 4;
    const bool filterFits = c.filter == "NONE" || (attributes && (c.filter == "OCTAHEDRAL" || c.filter == "COLOR" ? c.stride == 4 || c.stride == 8
                                                                  : c.filter == "QUATERNION" ? c.stride == 8 : c.filter == "EXPONENTIAL"));
    if (!strideFits) throw file.error(pointer, fmt::format("{} cannot be {} bytes apart", c.mode, c.stride));
    if (!filterFits) throw file.error(pointer, fmt::format("filter {} does not go with {} of {} bytes", c.filter, c.mode, c.stride));
    if (c.mode == "TRIANGLES" && c.count % 3 != 0) throw file.error(pointer, fmt::format("{} indices make no whole triangles", c.count));
    if (c.count > largestView / c.stride) throw file.error(pointer, fmt::format("{} elements of {} bytes are too many", c.count, c.stride));
    return c;
}

/// KHR_meshopt_compression, appendix B, filter 4: luma and chroma of K bits, K told by the highest bit of the last component.
template <class T> void decodeColors(std::span<std::byte> bytes) {
    using Signed = std::make_signed_t<T>;
    for (std::size_t at = 0; at + 4 * sizeof(T) <= bytes.size(); at += 4 * sizeof(T)) {
        std::array<T, 4> in;
        std::memcpy(in.data(), bytes.data() + at, sizeof in);
        const int y = in[0], co = static_cast<Signed>(in[1]), cg = static_cast<Signed>(in[2]);
        const int most = (1 << std::bit_width(static_cast<unsigned>(in[3]))) - 1, alpha = in[3] & (most >> 1);
        const float scale = most > 0 ? static_cast<float>(std::numeric_limits<T>::max()) / static_cast<float>(most) : 0.0f;
        const std::array<int, 4> colors{y + co - cg, y + cg, y - co - cg, alpha << 1 | (alpha & 1)};
        std::array<T, 4> out;
        for (std::size_t i = 0; i < 4; ++i)
            out[i] = static_cast<T>(std::clamp(std::round(static_cast<float>(colors[i]) * scale), 0.0f, static_cast<float>(std::numeric_limits<T>::max())));
        std::memcpy(bytes.data() + at, out.data(), sizeof out);
    }
}

void applyFilter(const Compressed& c, std::vector<std::byte>& data) {
    if (c.filter == "OCTAHEDRAL") meshopt_decodeFilterOct(data.data(), c.count, c.stride);
    if (c.filter == "QUATERNION") meshopt_decodeFilterQuat(data.data(), c.count, c.stride);
    if (c.filter == "EXPONENTIAL") meshopt_decodeFilterExp(data.data(), c.count, c.stride);
    if (c.filter == "COLOR" && c.stride == 4) decodeColors<std::uint8_t>(data);
    if (c.filter == "COLOR" && c.stride == 8) decodeColors<std::uint16_t>(data);
}

std::vector<std::byte> decode(const GltfFile& file, const Compressed& c, const std::string& pointer) {
    std::vector<std::byte> data(c.count * c.stride);
    if (c.count == 0) return data;
    const auto* bytes = reinterpret_cast<const unsigned char*>(c.bytes.data());
    bool failed = false;
    if (c.mode == "ATTRIBUTES" && isMeshoptVersion1(c.bytes)) {
        std::optional<std::vector<std::byte>> decoded = decodeMeshoptVersion1(c.bytes, c.count, c.stride);
        failed = !decoded;
        if (decoded) data = std::move(*decoded);
    } else {
        failed = c.mode == "ATTRIBUTES"  ? meshopt_decodeVertexBuffer(data.data(), c.count, c.stride, bytes, c.bytes.size())
                 : c.mode == "TRIANGLES" ? meshopt_decodeIndexBuffer(data.data(), c.count, c.stride, bytes, c.bytes.size())
                                         : meshopt_decodeIndexSequence(data.data(), c.count, c.stride, bytes, c.bytes.size());
    }
    if (failed) throw file.error(pointer, fmt::format("its {} bytes cannot be decoded", c.bytes.size()), "is the file damaged?");
    applyFilter(c, data);
    return data;
}

}  // namespace

void decodeMeshopt(GltfFile& file, Problems& problems) {
    for (std::size_t i = 0; i < file.model.bufferViews.size(); ++i) {
        tinygltf::BufferView& view = file.model.bufferViews[i];
        for (const char* name : {"KHR_meshopt_compression", "EXT_meshopt_compression"}) {
            const tinygltf::Value* object = findExtension(view.extensions, name);
            if (!object) continue;
            const std::string pointer = fmt::format("/bufferViews/{}/extensions/{}", i, name);
            try {
                const Compressed compressed = readExtension(file, *object, pointer);
                if (view.byteLength != compressed.count * compressed.stride)
                    throw file.error(pointer,
                                     fmt::format("{} elements of {} bytes are not the view's {} bytes", compressed.count, compressed.stride, view.byteLength));
                std::vector<std::byte> data = decode(file, compressed, pointer);
                file.buffers.push_back(std::move(data));
                view.buffer = static_cast<int>(file.buffers.size()) - 1;
                view.byteOffset = 0;
            } catch (const Error& error) {
                problems.add(error);
            }
            break;
        }
    }
}

}  // namespace lodestir
