// SPDX-License-Identifier: MIT
// Textures of a glTF model: images and samplers become Scene::textures, each combination once.
#pragma once
#include <framework/scene/gltf/import.h>

#include <map>
#include <tuple>

namespace lodestir {

class GltfTextures {
public:
    explicit GltfTextures(GltfImport& import) : import_(import) {}

    /// Scene texture for the file's texture `index`, empty until decode(); `none`, with a note, when it has no image.
    std::uint32_t use(int index, bool srgb);

    /// Reads and decodes every image that was asked for, on all cores. One that is missing, damaged or in a format that cannot be read
    /// (WebP, KTX, DDS) is taken out of the materials with a note.
    void decode();

private:
    using Key = std::tuple<int, bool, bool, Wrap, Wrap>;  // image, sRGB, nearest, wrap of u and v

    void leaveOut(int image);

    GltfImport& import_;
    std::map<Key, std::uint32_t> textures_;
    std::map<int, std::vector<std::uint32_t>> users_;  ///< Scene textures of each image
};

/// Decodes PNG or JPEG bytes to 8-bit RGBA into width, height and rgba of `texture`. True where the image had 16 bits a channel, which were
/// rounded. Error without a place when it cannot.
bool decodeImage(std::span<const std::byte> bytes, Texture& texture);

/// "WebP", "KTX" or "DDS": formats that glTF files name but that cannot be decoded here; else empty.
std::string_view foreignFormat(std::span<const std::byte> bytes);

}  // namespace lodestir
