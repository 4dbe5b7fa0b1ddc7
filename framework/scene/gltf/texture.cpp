// SPDX-License-Identifier: MIT
// Textures of a glTF model.
#include <framework/core/tasks.h>
#include <framework/image/png.h>
#include <framework/scene/gltf/accessor.h>
#include <framework/scene/gltf/texture.h>
#include <framework/scene/gltf/uri.h>
#include <framework/scene/visit.h>

#include <fmt/format.h>
#include <stb/stb_image.h>

#include <algorithm>
#include <memory>
#include <optional>

namespace lodestir {
namespace {

constexpr std::int64_t largestImage = std::int64_t(1) << 28;  // texels: 1 GiB once decoded
constexpr std::int64_t jpegTexelsPerByte = 512;               // at most: a block of 64 takes a bit at least

template <class T> using StbPixels = std::unique_ptr<T, decltype(&stbi_image_free)>;

Wrap wrapOf(int mode) {
    if (mode == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE) return Wrap::clamp;
    return mode == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT ? Wrap::mirror : Wrap::repeat;
}

std::vector<std::byte> imageBytes(const GltfFile& file, int index) {
    const Json& image = file.json.find("images")->items()[static_cast<std::size_t>(index)];
    if (const Json* uri = image.find("uri")) return readUri(uri->asString("uri"), file.path.parent_path());
    const Json* view = image.find("bufferView");
    if (!view) throw Error("the image has neither a URI nor a buffer view");
    const auto bytes = bufferViewBytes(file, static_cast<int>(std::clamp<std::int64_t>(view->asInt("bufferView"), -1, 0x7fffffff)));
    return {bytes.begin(), bytes.end()};
}

/// Empties the slots of a material that read a texture.
struct SlotCleaner {
    std::uint32_t texture;

    void operator()(TextureSlot& slot) const {
        if (slot.texture == texture) slot = {};
    }
    void operator()(std::optional<MaterialLayers>& layers) const {
        if (layers) visit(*this, *layers);
    }
    void operator()(auto&) const {}
};

}  // namespace

std::string_view foreignFormat(std::span<const std::byte> bytes) {
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), std::min<std::size_t>(bytes.size(), 16));
    if (text.size() >= 12 && text.starts_with("RIFF") && text.substr(8, 4) == "WEBP") return "WebP";
    if (text.starts_with("\xabKTX")) return "KTX";
    return text.starts_with("DDS ") ? "DDS" : "";
}

bool decodeImage(std::span<const std::byte> bytes, Texture& texture) {
    if (bytes.empty()) throw Error("the image has no data");
    if (bytes.size() > 0x7fffffff) throw Error("the image file is larger than 2 GiB");
    const auto* data = reinterpret_cast<const stbi_uc*>(bytes.data());
    const int size = static_cast<int>(bytes.size());
    // stb knows a dozen other formats, which no glTF file may hold and nobody here has tried with damaged files.
    const std::string_view start(reinterpret_cast<const char*>(data), std::min<std::size_t>(bytes.size(), 4));
    const bool isJpeg = start.starts_with("\xff\xd8");
    if (!isJpeg && start != "\x89PNG") throw Error("the image is neither PNG nor JPEG");
    if (!isJpeg && !hasWholeChunks({reinterpret_cast<const char*>(data), bytes.size()}))
        throw Error("the image cannot be decoded: it ends in the middle of a chunk", "is the file cut short?");
    int width = 0, height = 0, channels = 0;
    if (!stbi_info_from_memory(data, size, &width, &height, &channels)) {
        throw Error(fmt::format("the image cannot be read: {}", stbi_failure_reason()), "PNG and JPEG are supported");
    }
    if (std::int64_t(width) * height > largestImage) throw Error(fmt::format("the image has {}x{} texels, too many", width, height));
    // A JPEG may break off anywhere, the rest being grey: without this, ten bytes could ask for a gigabyte of it.
    if (isJpeg && std::int64_t(width) * height / jpegTexelsPerByte > size)
        throw Error(fmt::format("the image claims {}x{} texels, more than its {} bytes can hold", width, height, size), "is the file cut short?");
    const std::size_t values = std::size_t(4) * static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    const auto keep = [&](const auto* pixels, auto narrow) {
        if (!pixels) throw Error(fmt::format("the image cannot be decoded: {}", stbi_failure_reason()), "is the file cut short?");
        texture.width = width;
        texture.height = height;
        texture.rgba.resize(values);
        std::transform(pixels, pixels + values, texture.rgba.begin(), narrow);
    };
    const bool isWide = stbi_is_16_bit_from_memory(data, size);
    if (isWide) {
        const StbPixels<stbi_us> pixels(stbi_load_16_from_memory(data, size, &width, &height, &channels, 4), stbi_image_free);
        // To the nearest; stb itself drops the lower byte, up to a step away.
        keep(pixels.get(), [](stbi_us value) { return static_cast<std::uint8_t>((value * 255u + 32767u) / 65535u); });
    } else {
        const StbPixels<stbi_uc> pixels(stbi_load_from_memory(data, size, &width, &height, &channels, 4), stbi_image_free);
        keep(pixels.get(), [](stbi_uc value) { return value; });
    }
    return isWide;
}

std::uint32_t GltfTextures::use(int index, bool srgb) {
    const tinygltf::Model& model = import_.file.model;
    if (index < 0 || static_cast<std::size_t>(index) >= model.textures.size()) {
        import_.note(fmt::format("there is no texture {}, the file has {}; it is left out", index, model.textures.size()));
        return none;
    }
    const tinygltf::Texture& texture = model.textures[static_cast<std::size_t>(index)];
    const Json* images = import_.file.json.find("images");
    const std::size_t imageCount = images && images->isArray() ? images->items().size() : 0;
    if (texture.source < 0) {
        import_.note(fmt::format("texture {} names no PNG or JPEG image; it is left out", index));
        return none;
    }
    if (static_cast<std::size_t>(texture.source) >= imageCount) {
        import_.note(fmt::format("there is no image {}, the file has {}; texture {} is left out", texture.source, imageCount, index));
        return none;
    }
    tinygltf::Sampler sampler;
    if (texture.sampler >= 0 && static_cast<std::size_t>(texture.sampler) < model.samplers.size())
        sampler = model.samplers[static_cast<std::size_t>(texture.sampler)];
    else if (texture.sampler >= 0)
        import_.note(
            fmt::format("there is no sampler {}, the file has {}; texture {} repeats", texture.sampler, model.samplers.size(), index));
    const bool nearest = sampler.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST;
    const Key key{texture.source, srgb, nearest, wrapOf(sampler.wrapS), wrapOf(sampler.wrapT)};
    const auto [place, isNew] = textures_.try_emplace(key, static_cast<std::uint32_t>(import_.scene.textures.size()));
    if (isNew) {
        const Json& image = images->items()[static_cast<std::size_t>(texture.source)];
        const Json *name = image.find("name"), *uri = image.find("uri");
        const bool fileNamed = uri && uri->isString() && !isDataUri(uri->asString());
        import_.scene.textures.push_back({
            .name = name && name->isString() ? name->asString()
                    : fileNamed              ? percentDecode(uri->asString())
                                             : fmt::format("image {}", texture.source),
            .srgb = srgb,
            .nearest = nearest,
            .wrapU = std::get<3>(key),
            .wrapV = std::get<4>(key),
        });
        users_[texture.source].push_back(place->second);
    }
    return place->second;
}

void GltfTextures::decode() {
    const std::vector<std::pair<int, std::vector<std::uint32_t>>> images(users_.begin(), users_.end());
    std::vector<std::optional<Error>> errors(images.size());
    std::vector<std::string_view> foreign(images.size());
    std::vector<char> wide(images.size(), 0);
    const GltfFile& file = import_.file;
    parallelFor(images.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const auto& [index, users] = images[i];
            try {
                const std::vector<std::byte> bytes = imageBytes(file, index);
                foreign[i] = foreignFormat(bytes);
                if (!foreign[i].empty()) continue;
                Texture& first = import_.scene.textures[users[0]];
                wide[i] = decodeImage(bytes, first);
                for (std::size_t user = 1; user < users.size(); ++user) {
                    Texture& other = import_.scene.textures[users[user]];
                    other.width = first.width;
                    other.height = first.height;
                    other.rgba = first.rgba;
                }
            } catch (const Error& error) {
                errors[i] = error;
            }
        }
    });
    for (std::size_t i = 0; i < images.size(); ++i) {
        if (wide[i]) import_.note("images of 16 bits a channel are kept with 8");
        if (!foreign[i].empty()) import_.note(fmt::format("{} images cannot be read; textures of that format are left out", foreign[i]));
        if (errors[i]) import_.noteLeftOut(fmt::format("image {}", images[i].first), *errors[i]);
        if (errors[i] || !foreign[i].empty()) leaveOut(images[i].first);
    }
}

void GltfTextures::leaveOut(int image) {
    for (const std::uint32_t texture : users_[image]) {
        Texture& empty = import_.scene.textures[texture];
        empty.width = empty.height = 1;
        empty.rgba = {255, 255, 255, 255};
        for (std::size_t m = import_.materialBase; m < import_.scene.materials.size(); ++m) {
            Material& material = import_.scene.materials[m];
            if (material.emissiveMap.texture == texture && !material.unlit)
                material.emission = glm::vec3(0);  // as where a file has no such texture
            visit(SlotCleaner{texture}, material);
        }
    }
}

}  // namespace lodestir
