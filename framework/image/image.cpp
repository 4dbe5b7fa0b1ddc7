// SPDX-License-Identifier: MIT
// Making images and checking the sizes that files claim.
#include <framework/core/error.h>
#include <framework/image/image.h>

#include <algorithm>
#include <string>

namespace lodestir {

ImageData makeImage(int width, int height, int channels) {
    ImageData image{width, height, channels, {}};
    image.values.resize(image.pixelCount() * static_cast<std::size_t>(channels));
    return image;
}

ImageData firstChannels(const ImageData& image, int count) {
    assert(count > 0 && count <= image.channels);
    if (count == image.channels) return image;
    ImageData result = makeImage(image.width, image.height, count);
    for (std::size_t i = 0; i < image.pixelCount(); ++i) {
        std::copy_n(image.values.data() + i * static_cast<std::size_t>(image.channels), count,
                    result.values.data() + i * static_cast<std::size_t>(count));
    }
    return result;
}

ImageData withoutOpacity(const ImageData& image) { return image.hasOpacity ? firstChannels(image, image.channels - 1) : image; }

void checkImageSize(const std::filesystem::path& path, long long width, long long height, long long channels) {
    constexpr long long sideLimit = 65536, pixelLimit = 1ll << 27, channelLimit = 64, valueLimit = 1ll << 30;
    const bool sane = width > 0 && width <= sideLimit && height > 0 && height <= sideLimit && width * height <= pixelLimit &&
                      channels > 0 && channels <= channelLimit && width * height * channels <= valueLimit;
    if (!sane) {
        throw Error(Where{path.string()},
                    "claims to have " + std::to_string(width) + " x " + std::to_string(height) + " pixels of " + std::to_string(channels) +
                        " channels, which is not a size this program reads",
                    "the file may be damaged");
    }
}

}  // namespace lodestir
