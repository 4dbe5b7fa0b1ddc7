// SPDX-License-Identifier: MIT
// Percent-decoding, base64 and the reading of what a URI names.
#include <framework/core/error.h>
#include <framework/core/is_file.h>
#include <framework/scene/uri.h>

#include <fmt/format.h>

#include <array>
#include <cctype>
#include <cstdint>

namespace lodestir {
namespace {

constexpr std::size_t shownLength = 80;  // of a URI in a message: enough to recognise it, short of a pasted data URI

std::string shown(std::string_view uri) {
    return uri.size() <= shownLength ? std::string(uri) : fmt::format("{}...", uri.substr(0, shownLength));
}

int hexDigit(char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    if (c >= 'A' && c <= 'F') return c - 'A' + 10;
    return -1;
}

/// Value of a base64 digit in the standard or the URL-safe alphabet (RFC 4648, sections 4 and 5), or -1.
int base64Digit(char c) {
    if (c >= 'A' && c <= 'Z') return c - 'A';
    if (c >= 'a' && c <= 'z') return c - 'a' + 26;
    if (c >= '0' && c <= '9') return c - '0' + 52;
    if (c == '+' || c == '-') return 62;
    if (c == '/' || c == '_') return 63;
    return -1;
}

std::vector<std::byte> readDataUri(const std::string& uri) {
    const std::size_t comma = uri.find(',');
    if (comma == std::string::npos) throw Error(fmt::format("data URI \"{}\" has no comma before its data", shown(uri)));
    const std::string_view header = std::string_view(uri).substr(0, comma), data = std::string_view(uri).substr(comma + 1);
    if (header.ends_with(";base64")) {
        auto bytes = decodeBase64(data);
        if (!bytes) throw Error(fmt::format("data URI \"{}\" is not valid base64", shown(uri)));
        return std::move(*bytes);
    }
    const std::string text = percentDecode(data);
    const auto bytes = std::as_bytes(std::span(text));
    return {bytes.begin(), bytes.end()};
}

/// "http:", "file:" and the like; a single letter is a drive, not a scheme.
bool hasScheme(std::string_view uri) {
    std::size_t length = 0;
    while (length < uri.size() && (std::isalnum(static_cast<unsigned char>(uri[length])) || uri[length] == '+' || uri[length] == '-'))
        ++length;
    return length > 1 && length < uri.size() && uri[length] == ':';
}

}  // namespace

std::string percentDecode(std::string_view text) {
    std::string result;
    result.reserve(text.size());
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] == '%' && i + 2 < text.size() && hexDigit(text[i + 1]) >= 0 && hexDigit(text[i + 2]) >= 0) {
            result += static_cast<char>(hexDigit(text[i + 1]) * 16 + hexDigit(text[i + 2]));
            i += 2;
        } else {
            result += text[i];
        }
    }
    return result;
}

std::optional<std::vector<std::byte>> decodeBase64(std::string_view text) {
    while (!text.empty() && text.back() == '=') text.remove_suffix(1);
    if (text.size() % 4 == 1) return std::nullopt;
    std::vector<std::byte> bytes;
    bytes.reserve(text.size() * 3 / 4);
    std::uint32_t pending = 0;
    int bits = 0;
    for (char c : text) {
        const int digit = base64Digit(c);
        if (digit < 0) return std::nullopt;
        pending = (pending << 6 | static_cast<std::uint32_t>(digit)) & 0xffffffu;
        bits += 6;
        if (bits >= 8) {
            bits -= 8;
            bytes.push_back(static_cast<std::byte>(pending >> bits & 0xffu));
        }
    }
    return bytes;
}

std::vector<std::byte> readUri(const std::string& uri, const Path& folder) {
    if (uri.starts_with("data:")) return readDataUri(uri);
    if (hasScheme(uri))
        throw Error(fmt::format("\"{}\" is a network or absolute address", shown(uri)),
                    "put the file beside the model and name it by its path");
    Path path = folder / Path(percentDecode(uri));
    if (!isFile(path)) path = folder / Path(uri);
    if (!isFile(path))
        throw Error(fmt::format("file \"{}\" is missing", (folder / Path(percentDecode(uri))).string()));
    return readBytes(path);
}

}  // namespace lodestir
