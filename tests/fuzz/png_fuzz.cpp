// SPDX-License-Identifier: MIT
// Any bytes as a PNG or JPEG file. Checksums are mended first: else nothing would ever get past them.
#include "input_file.h"

#include <framework/image/jpeg.h>
#include <framework/image/png.h>
#include <framework/scene/gltf/texture.h>

#include <algorithm>
#include <cstring>
#include <vector>

namespace {

/// CRC-32 as the PNG specification defines it (polynomial 0xEDB88320, reflected).
std::uint32_t checksum(std::span<const std::uint8_t> bytes) {
    std::uint32_t crc = ~0u;
    for (const std::uint8_t byte : bytes) {
        crc ^= byte;
        for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ (crc & 1 ? 0xEDB88320u : 0);
    }
    return ~crc;
}

void mendChecksums(std::vector<std::uint8_t>& bytes) {
    for (std::size_t at = 8; at + 12 <= bytes.size();) {
        std::size_t length = 0;
        for (std::size_t i = 0; i < 4; ++i) length = length << 8 | bytes[at + i];
        if (length > bytes.size() - at - 12) return;
        const std::uint32_t crc = checksum(std::span(bytes).subspan(at + 4, length + 4));
        for (std::size_t i = 0; i < 4; ++i) bytes[at + 8 + length + i] = static_cast<std::uint8_t>(crc >> (24 - 8 * i));
        at += 12 + length;
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const lodestir::fuzz::Folder folder;
    std::vector<std::uint8_t> bytes(data, data + size);
    mendChecksums(bytes);
    const lodestir::Path file = folder.write("input.png", bytes);
    lodestir::fuzz::expectErrorOrResult([&] { lodestir::readPng(file); });
    lodestir::fuzz::expectErrorOrResult([&] { lodestir::readJpeg(file); });
    // Textures take their own way to the same decoder, and JPEG with it.
    lodestir::fuzz::expectErrorOrResult([&] {
        lodestir::Texture texture;
        lodestir::decodeImage(std::as_bytes(std::span(bytes)), texture);
    });
    return 0;
}
