// SPDX-License-Identifier: MIT
#include <framework/image/srgb.h>
#include <framework/scene/upload/mipmaps.h>

#include <algorithm>
#include <array>
#include <cstring>

namespace lodestir {
namespace {

const std::array<float, 256>& decodedBytes() {
    static const std::array<float, 256> table = [] {
        std::array<float, 256> values{};
        for (std::size_t i = 0; i < 256; ++i) values[i] = decodeSrgb(float(i) / 255);
        return values;
    }();
    return table;
}

std::uint8_t encodedByte(float linear) { return std::uint8_t(std::clamp(encodeSrgb(linear), 0.0f, 1.0f) * 255 + 0.5f); }

}  // namespace

std::uint32_t appendMipmaps(const Texture& texture, std::vector<std::uint32_t>& texels) {
    int width = texture.width, height = texture.height;
    std::size_t from = texels.size();
    texels.resize(from + std::size_t(width) * std::size_t(height));
    std::memcpy(&texels[from], texture.rgba.data(), 4 * std::size_t(width) * std::size_t(height));
    std::uint32_t levels = 1;
    while (width > 1 || height > 1) {
        const int w = std::max(1, width / 2), h = std::max(1, height / 2);
        const std::size_t to = texels.size();
        texels.resize(to + std::size_t(w) * std::size_t(h));
        for (int y = 0; y < h; ++y)
            for (int x = 0; x < w; ++x) {
                std::uint32_t out = 0;
                for (int c = 0; c < 4; ++c) {
                    float sum = 0;
                    unsigned plain = 0;
                    for (int k = 0; k < 4; ++k) {
                        const int sx = std::min(width - 1, 2 * x + (k & 1)), sy = std::min(height - 1, 2 * y + (k >> 1));
                        const std::uint8_t byte = std::uint8_t(texels[from + std::size_t(sy) * std::size_t(width) + std::size_t(sx)] >> (8 * c));
                        sum += decodedBytes()[byte];
                        plain += byte;
                    }
                    const bool curved = texture.srgb && c < 3;
                    out |= std::uint32_t(curved ? encodedByte(0.25f * sum) : std::uint8_t((plain + 2) / 4)) << (8 * c);
                }
                texels[to + std::size_t(y) * std::size_t(w) + std::size_t(x)] = out;
            }
        from = to;
        width = w;
        height = h;
        ++levels;
    }
    return levels;
}

}  // namespace lodestir
