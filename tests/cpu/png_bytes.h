// SPDX-License-Identifier: MIT
// PNG files made by hand, of kinds that this program does not write.
#pragma once
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace lodestir {

/// A PNG file of chunks, with their checksums; IEND comes by itself.
inline std::string pngFile(std::vector<std::pair<std::string, std::string>> chunks) {
    chunks.emplace_back("IEND", "");
    std::string file = "\x89PNG\r\n\x1a\n";
    const auto append = [&](std::uint32_t word) {
        for (int shift = 24; shift >= 0; shift -= 8) file += static_cast<char>(word >> shift);
    };
    for (const auto& [type, data] : chunks) {
        append(static_cast<std::uint32_t>(data.size()));
        std::uint32_t crc = ~0u;
        for (const char c : type + data) {
            crc ^= static_cast<unsigned char>(c);
            for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ (crc & 1 ? 0xEDB88320u : 0);
        }
        file += type + data;
        append(~crc);
    }
    return file;
}

/// IHDR of a row of pixels.
inline std::string pngHeader(int width, int bits, int kind) {
    return {0, 0, 0, static_cast<char>(width), 0, 0, 0, 1, static_cast<char>(bits), static_cast<char>(kind), 0, 0, 0};
}

/// zlib's form without compression, Adler-32 included.
inline std::string stored(const std::string& bytes) {
    std::uint32_t a = 1, b = 0;
    for (const char c : bytes) b = (b + (a = (a + static_cast<unsigned char>(c)) % 65521)) % 65521;
    const auto size = static_cast<std::uint16_t>(bytes.size());
    std::string block{
        0x78, 0x01, 1, static_cast<char>(size), static_cast<char>(size >> 8), static_cast<char>(~size), static_cast<char>(~size >> 8)};
    return block + bytes + std::string{static_cast<char>(b >> 8), static_cast<char>(b), static_cast<char>(a >> 8), static_cast<char>(a)};
}

}  // namespace lodestir
