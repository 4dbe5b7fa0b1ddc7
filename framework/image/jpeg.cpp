// SPDX-License-Identifier: MIT
#include <framework/core/error.h>
#include <framework/core/files.h>
#include <framework/image/jpeg.h>
#include <framework/image/srgb.h>

#include <stb/stb_image.h>

#include <algorithm>
#include <memory>

namespace lodestir {
namespace {

constexpr long long pixelsPerByte = 512;  ///< at most: a block of 64 takes a bit at least, and the rest of a cut file is grey

}  // namespace

ImageData readJpeg(const std::filesystem::path& path) {
    const std::string content = readText(path);
    const auto refuse = [&](const std::string& what) { throw Error(Where{path.string()}, what); };
    if (!content.starts_with("\xff\xd8")) refuse("is not a JPEG file");
    if (content.size() > 0x7fffffff) refuse("is larger than 2 GiB");
    const auto* bytes = reinterpret_cast<const stbi_uc*>(content.data());
    const int size = static_cast<int>(content.size());
    ImageData image;
    if (!stbi_info_from_memory(bytes, size, &image.width, &image.height, &image.channels))
        refuse(std::string("is damaged or cut: ") + stbi_failure_reason());
    checkImageSize(path, image.width, image.height, image.channels);
    if (static_cast<long long>(image.width) * image.height / pixelsPerByte > size) refuse("is cut: it claims more pixels than it can hold");
    const std::unique_ptr<stbi_uc, decltype(&stbi_image_free)> pixels(
        stbi_load_from_memory(bytes, size, &image.width, &image.height, &image.channels, 0), stbi_image_free);
    if (!pixels) refuse(std::string("is damaged or cut: ") + stbi_failure_reason());
    image.values.resize(image.pixelCount() * static_cast<std::size_t>(image.channels));
    std::transform(pixels.get(), pixels.get() + image.values.size(), image.values.begin(),
                   [](stbi_uc v) { return decodeSrgb(float(v) / 255); });
    return image;
}

}  // namespace lodestir
