// SPDX-License-Identifier: MIT
// Textures of a glTF model.
#include <framework/core/tasks.h>
#include <framework/scene/accessor.h>
#include <framework/scene/gltf_texture.h>
#include <framework/scene/uri.h>

#include <fmt/format.h>
#include <stb/stb_image.h>

#include <memory>
#include <optional>

namespace lodestir {
namespace {

constexpr std::int64_t largestImage = std::int64_t(1) << 28;  // texels: 1 GiB once decoded

Wrap wrapOf(int mode) {
    if (mode == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE) return Wrap::clamp;
    return mode == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT ? Wrap::mirror : Wrap::repeat;
}

std::string_view formatOf(std::span<const std::byte> bytes) {
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), std::min<std::size_t>(bytes.size(), 16));
    if (text.size() >= 12 && text.starts_with("RIFF") && text.substr(8, 4) == "WEBP") return "a WebP image";
    if (text.starts_with("\xabKTX")) return "a KTX image";
    if (text.starts_with("DDS ")) return "a DDS image";
    return {};
}

}  // namespace

void decodeImage(std::span<const std::byte> bytes, Texture& texture) {
    if (bytes.empty()) throw Error("the image has no data");
    if (const std::string_view foreign = formatOf(bytes); !foreign.empty()) {
        throw Error(fmt::format("{} cannot be read", foreign), "convert it to PNG or JPEG");
    }
    if (bytes.size() > 0x7fffffff) throw Error("the image file is larger than 2 GiB");
    const auto* data = reinterpret_cast<const stbi_uc*>(bytes.data());
    const int size = static_cast<int>(bytes.size());
    int width = 0, height = 0, channels = 0;
    if (!stbi_info_from_memory(data, size, &width, &height, &channels)) {
        throw Error(fmt::format("the image cannot be read: {}", stbi_failure_reason()), "PNG and JPEG are supported");
    }
    if (std::int64_t(width) * height > largestImage) throw Error(fmt::format("the image has {}x{} texels, too many", width, height));
    const std::unique_ptr<stbi_uc, void (*)(void*)> pixels(stbi_load_from_memory(data, size, &width, &height, &channels, 4), stbi_image_free);
    if (!pixels) throw Error(fmt::format("the image cannot be decoded: {}", stbi_failure_reason()), "is the file cut short?");
    texture.width = width;
    texture.height = height;
    texture.rgba.assign(pixels.get(), pixels.get() + std::size_t(4) * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
}

std::uint32_t GltfTextures::use(int index, bool srgb, const std::string& user) {
    const tinygltf::Model& model = import_.file.model;
    if (index < 0 || static_cast<std::size_t>(index) >= model.textures.size()) {
        import_.problem(user, fmt::format("there is no texture {}, the file has {}", index, model.textures.size()));
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
        import_.problem(fmt::format("/textures/{}/source", index), fmt::format("there is no image {}, the file has {}", texture.source, imageCount));
        return none;
    }
    tinygltf::Sampler sampler;
    if (texture.sampler >= 0) {
        if (static_cast<std::size_t>(texture.sampler) >= model.samplers.size()) {
            import_.problem(fmt::format("/textures/{}/sampler", index), fmt::format("there is no sampler {}, the file has {}", texture.sampler, model.samplers.size()));
            return none;
        }
        sampler = model.samplers[static_cast<std::size_t>(texture.sampler)];
    }
    const bool nearest = sampler.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST;
    const Key key{texture.source, srgb, nearest, wrapOf(sampler.wrapS), wrapOf(sampler.wrapT)};
    const auto [place, isNew] = textures_.try_emplace(key, static_cast<std::uint32_t>(import_.scene.textures.size()));
    if (isNew) {
        const Json& image = images->items()[static_cast<std::size_t>(texture.source)];
        const Json *name = image.find("name"), *uri = image.find("uri");
        const bool fileNamed = uri && uri->isString() && !uri->asString().starts_with("data:");
        import_.scene.textures.push_back({
            .name = name && name->isString() ? name->asString() : fileNamed ? percentDecode(uri->asString()) : fmt::format("image {}", texture.source),
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
    const GltfFile& file = import_.file;
    parallelFor(images.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const auto& [index, users] = images[i];
            const std::string pointer = fmt::format("/images/{}", index);
            try {
                const Json& image = file.json.find("images")->items()[static_cast<std::size_t>(index)];
                const Json *uri = image.find("uri"), *view = image.find("bufferView");
                Texture& first = import_.scene.textures[users[0]];
                if (uri) decodeImage(readUri(uri->asString("uri"), file.path.parent_path()), first);
                else if (view) decodeImage(bufferViewBytes(file, static_cast<int>(std::min<std::int64_t>(view->asInt("bufferView"), 0x7fffffff))), first);
                else throw Error("the image has neither a URI nor a buffer view");
                for (std::size_t user = 1; user < users.size(); ++user) {
                    Texture& other = import_.scene.textures[users[user]];
                    other.width = first.width;
                    other.height = first.height;
                    other.rgba = first.rgba;
                }
            } catch (const Error& error) {
                const Problem& problem = error.problems()[0];
                errors[i] = problem.where.file.empty() ? file.error(pointer, problem.what, problem.hint) : error;
            }
        }
    });
    for (const auto& error : errors) {
        if (error) import_.problems.add(*error);
    }
}

}  // namespace lodestir
