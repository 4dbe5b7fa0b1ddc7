// SPDX-License-Identifier: MIT
// The one road to the bytes of glTF buffers: every index, offset, stride and count is checked before a byte is read.
#pragma once
#include <framework/scene/gltf/file.h>

#include <glm/glm.hpp>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace lodestir {

/// Bytes of a buffer view. Error (at /bufferViews/`view`) when it or its buffer does not exist or it leaves the buffer.
std::span<const std::byte> bufferViewBytes(const GltfFile& file, int view);

/// A glTF accessor, sparse or not (glTF 2.0, section 3.6.2), checked by its constructor.
class Accessor {
public:
    /// Error (at /accessors/`index`, or at `user` when there is no such accessor) for anything that leaves its buffer view,
    /// an unknown component type, a matrix that isn't of 4x4 floats, sparse indices that do not rise or are past the count.
    Accessor(const GltfFile& file, int index, const std::string& user);

    std::size_t count() const { return count_; }
    int components() const { return components_; }            ///< of one element, 1 to 4; 16: a matrix, column by column
    bool hasData() const { return !base_.bytes.empty() || !replaced_.empty(); }  ///< else all elements are zeros
    const std::string& pointer() const { return pointer_; }  ///< JSON pointer, for messages

    /// count * components numbers; normalised integers become [0, 1] or [-1, 1] (section 3.6.2.2), other integers keep their value.
    std::vector<float> floats() const;
    /// The same as vectors, `fill` in what components V has more than the elements.
    template <class V> std::vector<V> vectors(V fill) const;
    /// Elements of an unsigned integer scalar accessor. Error when it is of another type.
    std::vector<std::uint32_t> indices() const;

private:
    struct Elements {
        std::span<const std::byte> bytes;  ///< from the first element on
        std::size_t stride = 0;
    };
    Elements locate(int view, std::size_t offset, std::size_t elementSize, std::size_t count, bool useStride,
                    const std::string& what) const;
    std::vector<std::uint32_t> sparseIndices() const;
    template <class T, class Read> std::vector<T> gather(std::size_t values, T none, const Read& read) const;

    const GltfFile& file_;
    const tinygltf::Accessor* source_ = nullptr;
    std::string pointer_;
    std::size_t count_ = 0, elementSize_ = 0;
    int components_ = 0, componentSize_ = 0;
    Elements base_, sparse_;  ///< no bytes: zeros, not sparse
    std::vector<std::uint32_t> replaced_;
};

}  // namespace lodestir
