// SPDX-License-Identifier: MIT
#include <framework/image/preview.h>

#include <algorithm>
#include <cmath>

namespace lodestir {

ImageData preview(const ImageData& image) {
    float largest = 0, smallest = 0;
    for (float v : image.values)
        if (std::isfinite(v)) {
            largest = std::max(largest, std::abs(v));
            smallest = std::min(smallest, v);
        }
    const float scale = largest > 0 ? 1 / largest : 0;
    if (image.channels == 1) {
        ImageData grey = image;
        for (float& v : grey.values) v *= scale;
        return grey;
    }
    if (image.channels == 2) {
        ImageData color = makeImage(image.width, image.height, 3);
        for (int y = 0; y < image.height; ++y)
            for (int x = 0; x < image.width; ++x) {
                for (int c = 0; c < 2; ++c) color.at(x, y, c) = 0.5f + 0.5f * scale * image.at(x, y, c);
                color.at(x, y, 2) = 0.5f;
            }
        return color;
    }
    ImageData color = firstChannels(image, 3);
    if (smallest < 0)
        for (float& v : color.values) v = 0.5f * (v + 1);
    return color;
}

}  // namespace lodestir
