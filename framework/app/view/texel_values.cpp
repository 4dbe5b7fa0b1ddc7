// SPDX-License-Identifier: MIT
#include <framework/app/view/texel_values.h>

#include <fmt/format.h>
#include <glm/gtc/packing.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <vector>

namespace lodestir {
namespace {

std::size_t bytesOf(std::uint32_t number) {
    switch (number) {
    case NUMBER_UNORM8:
    case NUMBER_UINT8: return 1;
    case NUMBER_FLOAT16:
    case NUMBER_UINT16: return 2;
    default: return 4;
    }
}

float pickFrom(const std::array<float, 4>& values, std::uint32_t channels, std::uint32_t pick) {
    if (pick == PICK_LUMINANCE) return 0.2126f * values[0] + 0.7152f * values[1] + 0.0722f * values[2];
    if (pick != PICK_LENGTH) return values[std::min(pick, 3u)];
    float sum = 0;
    for (std::uint32_t c = 0; c < channels; ++c) sum += values[c] * values[c];
    return std::sqrt(sum);
}

constexpr std::size_t mostTexels = 65536;  // that statistics are made of

/// The numbers of a texel; components that it hasn't are 0. False where the memory ends before.
bool readTexel(std::span<const std::byte> memory, std::size_t texel, const TexelLayout& layout, std::array<float, 4>& values) {
    const std::size_t bytes = bytesOf(layout.number), place = texel * layout.stride + layout.offset;
    values = {0, 0, 0, 0};
    if (place + layout.channels * bytes > memory.size()) return false;
    for (std::uint32_t c = 0; c < layout.channels; ++c) {
        std::uint32_t bits = 0;
        std::memcpy(&bits, memory.data() + place + c * bytes, bytes);
        values[c] = numberFrom(bits, layout.number);
    }
    return true;
}

/// The number that a share of the others is below.
float quantile(std::vector<float>& values, double share) {
    if (values.empty()) return 0;
    const auto place = std::ptrdiff_t(share * double(values.size() - 1) + 0.5);
    std::nth_element(values.begin(), values.begin() + place, values.end());
    return values[std::size_t(place)];
}

std::string scaled(double value, double step, std::initializer_list<const char*> units) {
    auto unit = units.begin();
    while (std::abs(value) >= step && unit + 1 != units.end()) {
        value /= step;
        ++unit;
    }
    if (unit == units.begin()) return fmt::format("{:.0f}{}", value, *unit);
    return fmt::format("{:.{}f}{}", value, value < 10 ? 2 : value < 100 ? 1 : 0, *unit);
}

}  // namespace

TexelLayout layoutOf(Format format) {
    const FormatFacts& facts = factsOf(format);
    TexelLayout layout{.stride = facts.bytes, .channels = facts.channels};
    switch (format) {
    case Format::r16f:
    case Format::rg16f:
    case Format::rgba16f: layout.number = NUMBER_FLOAT16; break;
    case Format::rgba8: layout.number = NUMBER_UNORM8; break;
    case Format::r32ui: layout.number = NUMBER_UINT32; break;
    default: break;
    }
    return layout;
}

std::optional<TexelLayout> layoutOf(const StructField& field, std::size_t base, std::size_t stride) {
    const NumberType type = numberType(field.type);
    if (type.kind == 0 || type.rows != 1 || type.columns > 4 || field.count != 0) return {};
    TexelLayout layout{.stride = std::uint32_t(stride), .offset = std::uint32_t(base + field.offset), .channels = std::uint32_t(type.columns)};
    if (type.kind == 'f') {
        if (type.bytes == 8) return {};
        layout.number = type.bytes == 2 ? NUMBER_FLOAT16 : NUMBER_FLOAT32;
    } else if (type.bytes == 4) {
        layout.number = type.kind == 'i' ? NUMBER_INT32 : NUMBER_UINT32;
    } else if (type.bytes == 8) {
        if (type.columns > 1) return {};
        layout.number = NUMBER_UINT32;  // the low half, which tells most apart
    } else {
        layout.number = type.bytes == 2 ? NUMBER_UINT16 : NUMBER_UINT8;
    }
    return layout;
}

bool isInteger(std::uint32_t number) { return number >= NUMBER_UINT32; }

float numberFrom(std::uint32_t bits, std::uint32_t number) {
    switch (number) {
    case NUMBER_FLOAT32: return std::bit_cast<float>(bits);
    case NUMBER_FLOAT16: return glm::unpackHalf1x16(std::uint16_t(bits));
    case NUMBER_UNORM8: return float(bits) / 255.0f;
    case NUMBER_INT32: return float(std::bit_cast<std::int32_t>(bits));
    default: return float(bits);
    }
}

std::string numberText(std::uint32_t bits, std::uint32_t number) {
    if (number == NUMBER_INT32) return fmt::format("{}", std::bit_cast<std::int32_t>(bits));
    if (isInteger(number)) return fmt::format("{}", bits);
    const float value = numberFrom(bits, number);
    if (!std::isfinite(value)) return fmt::format("{}", value);
    return fmt::format("{:#.5g}", value);
}

std::string probeText(glm::ivec2 pixel, const std::array<std::uint32_t, 4>& bits, const TexelLayout& layout) {
    std::string text = fmt::format("({}, {})", pixel.x, pixel.y);
    for (std::uint32_t c = 0; c < layout.channels; ++c) text += "  " + numberText(bits[c], layout.number);
    return text;
}

Statistics statisticsOf(std::span<const std::byte> memory, std::size_t count, const TexelLayout& layout, std::uint32_t pick) {
    const std::size_t step = std::max<std::size_t>(1, count / mostTexels);
    std::vector<float> picked, magnitudes;
    double sum = 0;
    std::size_t summed = 0;
    std::array<float, 4> values;
    for (std::size_t i = 0; i < count && readTexel(memory, i, layout, values); i += step) {
        for (std::uint32_t c = 0; c < layout.channels; ++c) {
            if (!std::isfinite(values[c])) continue;
            magnitudes.push_back(std::abs(values[c]));
            if (c < 3) {
                sum += values[c];
                ++summed;
            }
        }
        const float value = pickFrom(values, layout.channels, pick);
        if (std::isfinite(value)) picked.push_back(value);
    }
    Statistics statistics;
    statistics.low = quantile(picked, 0.005);
    statistics.high = quantile(picked, 0.995);
    statistics.largest = quantile(magnitudes, 0.995);
    statistics.mean = summed > 0 ? sum / double(summed) : 0;
    return statistics;
}

ImageData imageOf(std::span<const std::byte> memory, glm::uvec2 extent, const TexelLayout& layout) {
    ImageData image = makeImage(int(extent.x), int(extent.y), int(layout.channels));
    image.hasOpacity = layout.channels == 4;
    std::array<float, 4> values;
    for (std::size_t i = 0; i < image.pixelCount() && readTexel(memory, i, layout, values); ++i)
        std::copy_n(values.begin(), layout.channels, image.values.begin() + std::ptrdiff_t(i * layout.channels));
    return image;
}

Histograms histogramsOf(std::span<const ImageData* const> images, std::uint32_t pick, std::size_t bins) {
    std::vector<std::vector<float>> picked;
    std::vector<float> all;
    for (const ImageData* image : images) {
        std::vector<float>& numbers = picked.emplace_back();
        const auto channels = std::size_t(image->channels);
        for (std::size_t i = 0; i < image->pixelCount(); i += std::max<std::size_t>(1, image->pixelCount() / mostTexels)) {
            std::array<float, 4> values{0, 0, 0, 0};
            std::copy_n(image->values.begin() + std::ptrdiff_t(i * channels), std::min<std::size_t>(channels, 4), values.begin());
            const float value = pickFrom(values, std::uint32_t(channels), pick);
            if (std::isfinite(value)) numbers.push_back(value);
        }
        all.insert(all.end(), numbers.begin(), numbers.end());
    }
    Histograms histograms{.low = quantile(all, 0.005), .high = quantile(all, 0.995), .shares = {}};
    const float scale = float(bins) / std::max(histograms.high - histograms.low, 1e-30f);
    for (const std::vector<float>& numbers : picked) {
        std::vector<float>& shares = histograms.shares.emplace_back(bins);
        for (const float value : numbers) {
            const float bin = std::clamp((value - histograms.low) * scale, 0.0f, float(bins - 1));
            shares[std::size_t(bin)] += 1 / float(numbers.size());
        }
    }
    return histograms;
}

std::string countText(double count) { return scaled(count, 1000, {"", " k", " M", " G"}); }
std::string bytesText(double bytes) { return scaled(bytes, 1024, {" B", " KiB", " MiB", " GiB"}); }

}  // namespace lodestir
