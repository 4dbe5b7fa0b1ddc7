// SPDX-License-Identifier: MIT
// Bounds-checked reading of glTF accessors.
#include <framework/core/tasks.h>
#include <framework/scene/gltf/accessor.h>

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

namespace lodestir {
namespace {

/// An accessor without a buffer view costs its file nothing, so a typing mistake could ask for all memory there is.
constexpr std::size_t largestWithoutData = std::size_t(1) << 20;

int sizeOf(int componentType) {
    switch (componentType) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE: return 1;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT: return 2;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
    case TINYGLTF_COMPONENT_TYPE_FLOAT: return 4;
    default: return 0;
    }
}

int componentsOf(int type) {
    switch (type) {
    case TINYGLTF_TYPE_SCALAR: return 1;
    case TINYGLTF_TYPE_VEC2: return 2;
    case TINYGLTF_TYPE_VEC3: return 3;
    case TINYGLTF_TYPE_VEC4: return 4;
    case TINYGLTF_TYPE_MAT4: return 16;
    default: return 0;
    }
}

template <class T> T load(const std::byte* bytes) {
    T value;
    std::memcpy(&value, bytes, sizeof value);
    return value;
}

std::uint32_t loadUnsigned(const std::byte* bytes, int size) {
    if (size == 1) return load<std::uint8_t>(bytes);
    if (size == 2) return load<std::uint16_t>(bytes);
    return load<std::uint32_t>(bytes);
}

/// One component as a number: f = c / max for unsigned, max(c / max, -1) for signed normalised integers.
float loadNumber(const std::byte* bytes, int componentType, bool normalized) {
    switch (componentType) {
    case TINYGLTF_COMPONENT_TYPE_BYTE: {
        const float c = load<std::int8_t>(bytes);
        return normalized ? std::max(c / 127, -1.0f) : c;
    }
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE: return normalized ? load<std::uint8_t>(bytes) / 255.0f : load<std::uint8_t>(bytes);
    case TINYGLTF_COMPONENT_TYPE_SHORT: {
        const float c = load<std::int16_t>(bytes);
        return normalized ? std::max(c / 32767, -1.0f) : c;
    }
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT: return normalized ? load<std::uint16_t>(bytes) / 65535.0f : load<std::uint16_t>(bytes);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT: return static_cast<float>(load<std::uint32_t>(bytes) / (normalized ? 4294967295.0 : 1.0));
    default: return load<float>(bytes);
    }
}

}  // namespace

std::span<const std::byte> bufferViewBytes(const GltfFile& file, int view) {
    const std::string pointer = fmt::format("/bufferViews/{}", view);
    const auto& views = file.model.bufferViews;
    if (view < 0 || static_cast<std::size_t>(view) >= views.size()) {
        throw file.error(pointer, fmt::format("there is no buffer view {}, the file has {}", view, views.size()));
    }
    const tinygltf::BufferView& v = views[static_cast<std::size_t>(view)];
    if (v.buffer < 0 || static_cast<std::size_t>(v.buffer) >= file.buffers.size()) {
        throw file.error(pointer + "/buffer", fmt::format("there is no buffer {}, the file has {}", v.buffer, file.buffers.size()));
    }
    const std::span<const std::byte> buffer = file.buffers[static_cast<std::size_t>(v.buffer)];
    if (buffer.empty() && v.byteLength > 0) {
        throw file.error(fmt::format("/buffers/{}", v.buffer),
                         file.binary ? "the buffer has no URI and the file no binary chunk for it" : "the buffer has no URI");
    }
    if (v.byteOffset > buffer.size() || v.byteLength > buffer.size() - v.byteOffset) {
        throw file.error(pointer, fmt::format("bytes {} to {} are not all inside buffer {} of {} bytes", v.byteOffset,
                                              v.byteOffset + v.byteLength, v.buffer, buffer.size()));
    }
    return buffer.subspan(v.byteOffset, v.byteLength);
}

Accessor::Accessor(const GltfFile& file, int index, const std::string& user) : file_(file), pointer_(fmt::format("/accessors/{}", index)) {
    const auto& accessors = file.model.accessors;
    if (index < 0 || static_cast<std::size_t>(index) >= accessors.size()) {
        throw file.error(user, fmt::format("there is no accessor {}, the file has {}", index, accessors.size()));
    }
    source_ = &accessors[static_cast<std::size_t>(index)];
    componentSize_ = sizeOf(source_->componentType);
    components_ = componentsOf(source_->type);
    count_ = source_->count;
    if (componentSize_ == 0)
        throw file.error(pointer_ + "/componentType", fmt::format("component type {} is none of glTF's", source_->componentType));
    if (components_ == 0 || (components_ == 16 && source_->componentType != TINYGLTF_COMPONENT_TYPE_FLOAT))
        throw file.error(pointer_ + "/type", "elements of this type cannot be used here", "SCALAR, VEC2, VEC3, VEC4, or MAT4 of floats");
    elementSize_ = static_cast<std::size_t>(componentSize_ * components_);

    if (source_->bufferView >= 0) {
        base_ = locate(source_->bufferView, source_->byteOffset, elementSize_, count_, true, "its");
    } else if (count_ > largestWithoutData) {
        throw file.error(pointer_ + "/count", fmt::format("{} elements without a buffer view are too many to be meant", count_));
    }
    if (source_->sparse.isSparse) {
        replaced_ = sparseIndices();
        const auto offset = static_cast<std::size_t>(std::max(source_->sparse.values.byteOffset, 0));
        sparse_ = locate(source_->sparse.values.bufferView, offset, elementSize_, replaced_.size(), false, "its sparse values'");
    }
}

Accessor::Elements Accessor::locate(int view, std::size_t offset, std::size_t elementSize, std::size_t count, bool useStride,
                                    const std::string& what) const {
    const std::span<const std::byte> bytes = bufferViewBytes(file_, view);
    const std::size_t viewStride = useStride ? file_.model.bufferViews[static_cast<std::size_t>(view)].byteStride : 0;
    const std::size_t stride = viewStride ? viewStride : elementSize;
    if (stride < elementSize) {
        throw file_.error(pointer_,
                          fmt::format("an element has {} bytes, more than {} buffer view's stride of {}", elementSize, what, stride));
    }
    if (count == 0) return {};
    const bool firstFits = offset <= bytes.size() && elementSize <= bytes.size() - offset;
    if (!firstFits || (count - 1) > (bytes.size() - offset - elementSize) / stride) {
        throw file_.error(pointer_,
                          fmt::format("{} elements of {} bytes, {} bytes apart, from byte {} on leave {} buffer view {} of {} bytes", count,
                                      elementSize, stride, offset, what, view, bytes.size()));
    }
    return {bytes.subspan(offset), stride};
}

std::vector<std::uint32_t> Accessor::sparseIndices() const {
    const auto& sparse = source_->sparse;
    const int type = sparse.indices.componentType, size = sizeOf(type);
    if (type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE && type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT &&
        type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT) {
        throw file_.error(pointer_ + "/sparse/indices/componentType", "sparse indices must be unsigned integers");
    }
    if (sparse.count < 0 || static_cast<std::size_t>(sparse.count) > count_) {
        throw file_.error(pointer_ + "/sparse/count", fmt::format("{} replaced elements of {}", sparse.count, count_));
    }
    const auto count = static_cast<std::size_t>(sparse.count), offset = static_cast<std::size_t>(std::max(sparse.indices.byteOffset, 0));
    const Elements source = locate(sparse.indices.bufferView, offset, static_cast<std::size_t>(size), count, false, "its sparse indices'");
    std::vector<std::uint32_t> result(count);
    for (std::size_t i = 0; i < count; ++i) {
        result[i] = loadUnsigned(source.bytes.data() + i * source.stride, size);
        if (result[i] >= count_)
            throw file_.error(pointer_ + "/sparse/indices", fmt::format("sparse index {} is past the {} elements", result[i], count_));
        if (i > 0 && result[i] <= result[i - 1]) throw file_.error(pointer_ + "/sparse/indices", "sparse indices must rise");
    }
    return result;
}

/// Elements in order, the replaced ones replaced, `none` where there are no data; read(bytes, out) converts one element to its T values.
template <class T, class Read> std::vector<T> Accessor::gather(std::size_t values, T none, const Read& read) const {
    std::vector<T> result(count_ * values, none);
    if (!base_.bytes.empty()) {
        parallelFor(count_, 65536, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) read(base_.bytes.data() + i * base_.stride, &result[i * values]);
        });
    }
    for (std::size_t i = 0; i < replaced_.size(); ++i) read(sparse_.bytes.data() + i * sparse_.stride, &result[replaced_[i] * values]);
    return result;
}

std::vector<float> Accessor::floats() const {
    const int type = source_->componentType;
    return gather<float>(static_cast<std::size_t>(components_), 0, [&](const std::byte* element, float* out) {
        for (int c = 0; c < components_; ++c) out[c] = loadNumber(element + c * componentSize_, type, source_->normalized);
    });
}

template <class V> std::vector<V> Accessor::vectors(V fill) const {
    const int type = source_->componentType;
    for (int c = 0; c < components_; ++c) fill[c] = 0;  // what has no data is zero
    if (type == TINYGLTF_COMPONENT_TYPE_FLOAT && components_ == V::length())
        return gather<V>(1, fill, [](const std::byte* element, V* out) { *out = load<V>(element); });
    return gather<V>(1, fill, [&](const std::byte* element, V* out) {
        for (int c = 0; c < components_; ++c) (*out)[c] = loadNumber(element + c * componentSize_, type, source_->normalized);
    });
}

template std::vector<glm::vec2> Accessor::vectors(glm::vec2) const;
template std::vector<glm::vec3> Accessor::vectors(glm::vec3) const;
template std::vector<glm::vec4> Accessor::vectors(glm::vec4) const;

std::vector<std::uint32_t> Accessor::indices() const {
    const int type = source_->componentType;
    const bool unsignedType = type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE || type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
                              type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
    if (!unsignedType || components_ != 1) throw file_.error(pointer_, "indices must be unsigned integer scalars");
    return gather<std::uint32_t>(1, 0, [&](const std::byte* element, std::uint32_t* out) { *out = loadUnsigned(element, componentSize_); });
}

}  // namespace lodestir
