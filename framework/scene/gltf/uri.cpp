// SPDX-License-Identifier: MIT
// Percent-decoding, base64 and the reading of what a URI names.
#include <framework/core/error.h>
#include <framework/core/is_file.h>
#include <framework/scene/gltf/uri.h>

#include <fmt/format.h>

#include <algorithm>
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

bool startsWithScheme(std::string_view uri, std::string_view scheme) {
    return uri.size() >= scheme.size() && std::ranges::equal(uri.substr(0, scheme.size()), scheme, {}, [](unsigned char c) {
               return static_cast<char>(std::tolower(c));  // schemes are the same in capitals (RFC 3986, section 3.1)
           });
}

/// The path of a file: URI (RFC 8089): of this machine, or relative, which is none but is meant by those who write it.
std::string_view pathOfFileUri(std::string_view uri) {
    uri.remove_prefix(std::string_view("file:").size());
    if (!uri.starts_with("//")) return uri;
    uri.remove_prefix(2);
    if (startsWithScheme(uri, "localhost/")) uri.remove_prefix(uri.find('/'));
    return uri;
}

/// "http:" and the like; a single letter is a drive, not a scheme.
bool hasScheme(std::string_view uri) {
    std::size_t length = 0;
    while (length < uri.size() && (std::isalnum(static_cast<unsigned char>(uri[length])) || uri[length] == '+' || uri[length] == '-'))
        ++length;
    return length > 1 && length < uri.size() && uri[length] == ':';
}

}  // namespace

bool isDataUri(std::string_view uri) { return startsWithScheme(uri, "data:"); }

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
    if (isDataUri(uri)) return readDataUri(uri);
    const bool isFileUri = startsWithScheme(uri, "file:");
    const std::string name(isFileUri ? pathOfFileUri(uri) : uri), decoded = percentDecode(name);
    for (const std::string& candidate : {decoded, name})
        if (const Path path = namedPath(folder, candidate); isFile(path)) return readBytes(path);
    if (hasScheme(uri) && !isFileUri)
        throw Error(fmt::format("\"{}\" is a network address", shown(uri)), "put the file beside the model and name it by its path");
    throw Error(fmt::format("file \"{}\" is missing", (folder / decoded).string()));
}

}  // namespace lodestir
