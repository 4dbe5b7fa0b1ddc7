// SPDX-License-Identifier: MIT
// Reads and writes PNG files by means of stb, which trusts what it reads: chunks and their checksums are looked at here first.
#include <framework/core/error.h>
#include <framework/core/files.h>
#include <framework/core/log.h>
#include <framework/image/png.h>
#include <framework/image/srgb.h>

#include <stb/stb_image.h>
#include <stb/stb_image_write.h>

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <string_view>

namespace lodestir {
namespace {

constexpr std::string_view signature = "\x89PNG\r\n\x1a\n";

/// CRC-32 as the PNG specification defines it (polynomial 0xEDB88320, reflected).
std::uint32_t checksum(std::string_view bytes) {
    static constexpr auto table = [] {
        std::array<std::uint32_t, 256> entries{};
        for (std::uint32_t i = 0; i < 256; ++i) {
            entries[i] = i;
            for (int bit = 0; bit < 8; ++bit) entries[i] = (entries[i] >> 1) ^ (entries[i] & 1 ? 0xEDB88320u : 0);
        }
        return entries;
    }();
    std::uint32_t crc = ~0u;
    for (const char c : bytes) crc = table[(crc ^ static_cast<unsigned char>(c)) & 0xFF] ^ (crc >> 8);
    return ~crc;
}

std::uint32_t bigEndian(std::string_view bytes) {
    std::uint32_t value = 0;
    for (int i = 0; i < 4; ++i) value = value << 8 | static_cast<unsigned char>(bytes[static_cast<std::size_t>(i)]);
    return value;
}

/// What is wrong with the sequence of chunks (length, type, data, checksum; IHDR first, IEND last), if anything.
std::optional<std::string> flaw(std::string_view bytes) {
    bytes.remove_prefix(signature.size());
    for (bool first = true;; first = false) {
        if (bytes.size() < 12) return "it ends too early";
        const std::uint32_t length = bigEndian(bytes);
        const std::string_view type = bytes.substr(4, 4);
        if (first && (type != "IHDR" || length != 13)) return "it doesn't start with a header";
        if (length > bytes.size() - 12) return "it ends too early";
        const bool isCritical = (type[0] & 0x20) == 0;  // by the case of the first letter; the others only carry remarks
        if (isCritical && checksum(bytes.substr(4, 4 + length)) != bigEndian(bytes.substr(8 + length))) {
            return "the checksum of its " + std::string(type) + " chunk is wrong";
        }
        if (type == "IEND") return {};
        bytes.remove_prefix(12 + length);
    }
}

/// What a gAMA chunk says (PNG specification, 11.3.2.2: the exponent of encoding, times 100000) where that isn't sRGB's curve and no better
/// chunk overrules it; else 0.
std::uint32_t foreignGamma(std::string_view bytes) {
    constexpr std::uint32_t least = 43000, most = 48000;  // about 1 / 2.2, by which sRGB is told to old readers
    std::uint32_t gamma = 0;
    for (bytes.remove_prefix(signature.size()); bytes.substr(4, 4) != "IDAT" && bytes.substr(4, 4) != "IEND";) {
        const std::uint32_t length = bigEndian(bytes);
        const std::string_view type = bytes.substr(4, 4);
        if (type == "sRGB" || type == "iCCP" || type == "cICP") return 0;
        if (type == "gAMA" && length == 4) gamma = bigEndian(bytes.substr(8));
        bytes.remove_prefix(12 + length);
    }
    return gamma >= least && gamma <= most ? 0 : gamma;
}

template <class T> using Pixels = std::unique_ptr<T, decltype(&stbi_image_free)>;

}  // namespace

bool hasWholeChunks(std::string_view png) {
    constexpr std::size_t frame = 12;  // length, type, checksum
    for (std::size_t at = signature.size();;) {
        if (png.size() < at + frame) return false;
        const std::size_t length = bigEndian(png.substr(at));
        if (length > png.size() - at - frame) return false;
        if (png.substr(at + 4, 4) == "IEND") return true;
        at += frame + length;
    }
}

ImageData readPng(const Path& path) {
    const std::string content = readText(path);
    const auto refuse = [&](const std::string& what) { throw Error(Where{path.string()}, what); };
    if (!content.starts_with(signature)) refuse("is not a PNG file");
    if (const auto found = flaw(content)) refuse("is damaged or cut: " + *found);
    checkImageSize(path, bigEndian(std::string_view(content).substr(16)), bigEndian(std::string_view(content).substr(20)), 4);

    if (const std::uint32_t gamma = foreignGamma(content); gamma != 0)
        log::warn("{}: says that its values are encoded with the exponent {}; they are taken as sRGB", path.string(), gamma / 1e5);
    const auto* bytes = reinterpret_cast<const stbi_uc*>(content.data());
    const int size = static_cast<int>(content.size());
    ImageData image;
    const auto fill = [&](const auto* encoded, float top) {
        if (!encoded) refuse(std::string("is damaged or cut: ") + stbi_failure_reason());
        image.hasOpacity = image.channels % 2 == 0;
        const int opacity = image.hasOpacity ? image.channels - 1 : -1;
        image.values.resize(image.pixelCount() * static_cast<std::size_t>(image.channels));
        for (std::size_t i = 0; i < image.values.size(); ++i) {
            const float value = static_cast<float>(encoded[i]) / top;
            image.values[i] = static_cast<int>(i % static_cast<std::size_t>(image.channels)) == opacity ? value : decodeSrgb(value);
        }
    };
    if (stbi_is_16_bit_from_memory(bytes, size)) {
        const Pixels<stbi_us> pixels(stbi_load_16_from_memory(bytes, size, &image.width, &image.height, &image.channels, 0),
                                     stbi_image_free);
        fill(pixels.get(), 65535);
    } else {
        const Pixels<stbi_uc> pixels(stbi_load_from_memory(bytes, size, &image.width, &image.height, &image.channels, 0), stbi_image_free);
        fill(pixels.get(), 255);
    }
    return image;
}

void writePng(const Path& path, const ImageData& image) {
    if (image.channels != 1 && image.channels != 3 && image.channels != 4) {
        throw Error(Where{path.string()}, "cannot be written: a PNG file has 1, 3 or 4 channels, not " + std::to_string(image.channels),
                    "write OpenEXR (.exr)");
    }
    std::vector<unsigned char> encoded(image.values.size());
    for (std::size_t i = 0; i < encoded.size(); ++i) {
        const bool isOpacity = image.channels == 4 && i % 4 == 3;
        const float value = image.values[i] > 0 ? std::min(image.values[i], 1.0f) : 0.0f;  // NaN compares false
        encoded[i] = static_cast<unsigned char>((isOpacity ? value : encodeSrgb(value)) * 255 + 0.5f);
    }
    std::string bytes;
    const auto append = [](void* to, void* data, int size) {
        static_cast<std::string*>(to)->append(static_cast<const char*>(data), static_cast<std::size_t>(size));
    };
    if (!stbi_write_png_to_func(append, &bytes, image.width, image.height, image.channels, encoded.data(), image.width * image.channels)) {
        throw Error(Where{path.string()}, "cannot be written: the image could not be encoded");
    }
    writeFile(path, bytes);
}

}  // namespace lodestir
