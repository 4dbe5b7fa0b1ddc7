// SPDX-License-Identifier: MIT
// The hash that names cache files: two 64-bit lanes of multiply and rotate over words of eight bytes.
// The bytes of one add() are one unit: its length takes part, so that ("ab", "c") and ("a", "bc") differ.
#include <framework/core/files.h>

#include <bit>
#include <cstring>

namespace lodestir {
namespace {

static_assert(std::endian::native == std::endian::little,
              "words are read as they lie; the same content must have the same name everywhere");

// Odd constants from the fractional parts of the golden ratio and of square roots: multiplying by them is a bijection that spreads low
// bits upwards.
constexpr std::uint64_t golden = 0x9e3779b97f4a7c15ull, root2 = 0x6a09e667f3bcc909ull, root3 = 0xbb67ae8584caa73bull,
                        root5 = 0x3c6ef372fe94f82bull;

/// The finishing mix of a lane: every input bit changes about half of the output bits (shift-multiply form, as in splitmix64).
std::uint64_t mix(std::uint64_t x) {
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ull;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebull;
    return x ^ (x >> 31);
}

void addWord(Hash& hash, std::uint64_t word) {
    hash.a = std::rotl(hash.a ^ (word * golden), 31) * root2 + root3;
    hash.b = std::rotl(hash.b + (word ^ root5) * root3, 29) * golden + root2;
}

}  // namespace

Hash& Hash::add(std::span<const std::byte> bytes) {
    const std::size_t length = bytes.size();
    for (; bytes.size() >= 8; bytes = bytes.subspan(8)) {
        std::uint64_t word = 0;
        std::memcpy(&word, bytes.data(), 8);
        addWord(*this, word);
    }
    std::uint64_t rest = 0;
    if (!bytes.empty()) std::memcpy(&rest, bytes.data(), bytes.size());
    addWord(*this, rest);
    addWord(*this, length);
    const std::uint64_t before = a;
    a = mix(a + std::rotl(b, 17));
    b = mix(b ^ before);
    return *this;
}

Hash& Hash::add(std::string_view text) { return add(std::as_bytes(std::span(text))); }

std::string Hash::hex() const {
    constexpr char digits[] = "0123456789abcdef";
    std::string text;
    for (const std::uint64_t lane : {a, b}) {
        for (int shift = 60; shift >= 0; shift -= 4) text += digits[(lane >> shift) & 15];
    }
    return text;
}

}  // namespace lodestir
