// SPDX-License-Identifier: MIT
#include <framework/image/exr_attributes.h>

#include <cstdint>
#include <cstring>
#include <string_view>
#include <utility>

namespace lodestir {
namespace {

constexpr std::uint32_t multiPart = 0x1000;  // in the version field

/// Bytes of the types whose values all have the same.
constexpr std::pair<std::string_view, std::size_t> fixedSizes[] = {
    {"box2f", 16},
    {"box2i", 16},
    {"chromaticities", 32},
    {"compression", 1},
    {"deepImageState", 1},
    {"double", 8},
    {"envmap", 1},
    {"float", 4},
    {"int", 4},
    {"keycode", 28},
    {"lineOrder", 1},
    {"m33d", 72},
    {"m33f", 36},
    {"m44d", 128},
    {"m44f", 64},
    {"rational", 8},
    {"tiledesc", 9},
    {"timecode", 8},
    {"v2d", 16},
    {"v2f", 8},
    {"v2i", 8},
    {"v3d", 24},
    {"v3f", 12},
    {"v3i", 12},
};

/// Bytes that are taken from the front, none that are not there.
class Bytes {
public:
    explicit Bytes(std::string_view bytes) : rest_(bytes) {}

    bool isEmpty() const { return rest_.empty(); }
    std::optional<std::string_view> take(std::size_t count) {
        if (count > rest_.size()) return {};
        const std::string_view taken = rest_.substr(0, count);
        rest_.remove_prefix(count);
        return taken;
    }
    std::optional<std::uint32_t> takeWord() {
        const auto bytes = take(4);
        if (!bytes) return {};
        std::uint32_t word;
        std::memcpy(&word, bytes->data(), sizeof word);
        return word;
    }
    /// Up to a zero, which is taken, too.
    std::optional<std::string_view> takeName() {
        const std::size_t end = rest_.find('\0');
        if (end == rest_.npos) return {};
        const std::string_view name = rest_.substr(0, end);
        rest_.remove_prefix(end + 1);
        return name;
    }

private:
    std::string_view rest_;
};

/// Do channels (name, 16 bytes of facts) fill a value up to its closing zero?
bool isChannelList(Bytes value) {
    for (;;) {
        const auto name = value.takeName();
        if (!name) return false;
        if (name->empty()) return value.isEmpty();
        if (!value.take(16)) return false;
    }
}

bool isStringList(Bytes value) {
    while (!value.isEmpty()) {
        const auto length = value.takeWord();
        if (!length || !value.take(*length)) return false;
    }
    return true;
}

bool isPreview(Bytes value) {
    const auto width = value.takeWord(), height = value.takeWord();
    constexpr std::uint64_t texel = 4;
    return width && height && *height <= UINT32_MAX / texel && value.take(std::size_t(*width * (*height * texel))) && value.isEmpty();
}

bool fits(std::string_view type, std::string_view value) {
    for (const auto& [name, size] : fixedSizes)
        if (type == name) return value.size() == size;
    if (type == "chlist") return isChannelList(Bytes(value));
    if (type == "stringvector") return isStringList(Bytes(value));
    if (type == "preview") return isPreview(Bytes(value));
    return type != "floatvector" || value.size() % sizeof(float) == 0;
}

}  // namespace

std::optional<std::string> attributeFlaw(std::span<const std::byte> file) {
    Bytes bytes({reinterpret_cast<const char*>(file.data()), file.size()});
    bytes.take(4);  // the magic number
    const auto version = bytes.takeWord();
    if (!version) return "it ends too early";
    for (bool isFirst = true;; isFirst = true) {  // a header; where there are several, an empty one ends them
        for (;; isFirst = false) {
            const auto name = bytes.takeName();
            if (!name) return "it ends too early";
            if (name->empty()) break;
            const auto type = bytes.takeName();
            const auto size = bytes.takeWord();
            const auto value = size ? bytes.take(*size) : std::nullopt;
            if (!type || !value) return "its attribute \"" + std::string(name->substr(0, 32)) + "\" leaves the file";
            if (!fits(*type, *value)) return "its attribute \"" + std::string(name->substr(0, 32)) + "\" has a wrong size";
        }
        if (isFirst || !(*version & multiPart)) return {};
    }
}

}  // namespace lodestir
