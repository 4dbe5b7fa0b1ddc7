// SPDX-License-Identifier: MIT
#include <framework/graph/texels.h>

#include <glm/gtc/packing.hpp>

#include <cstring>

namespace lodestir {
namespace {

template <class T> T take(std::span<const std::byte> bytes, std::size_t index) {
    T value;
    std::memcpy(&value, bytes.data() + index * sizeof(T), sizeof(T));
    return value;
}

}  // namespace

ImageData decodeTexels(std::span<const std::byte> bytes, Format format, glm::uvec2 extent) {
    const FormatFacts& facts = factsOf(format);
    ImageData image;
    image.width = int(extent.x);
    image.height = int(extent.y);
    image.channels = int(facts.channels);
    image.hasOpacity = image.channels == 4;  // or what else a pass keeps beside three values: no light
    image.values.resize(std::size_t(extent.x) * extent.y * facts.channels);
    for (std::size_t i = 0; i < image.values.size(); ++i) switch (format) {
            case Format::r32f:
            case Format::rg32f:
            case Format::rgba32f: image.values[i] = take<float>(bytes, i); break;
            case Format::r16f:
            case Format::rg16f:
            case Format::rgba16f: image.values[i] = glm::unpackHalf1x16(take<std::uint16_t>(bytes, i)); break;
            case Format::rgba8: image.values[i] = float(take<std::uint8_t>(bytes, i)) / 255.0f; break;
            case Format::r32ui: image.values[i] = float(take<std::uint32_t>(bytes, i)); break;
        }
    return image;
}

}  // namespace lodestir
