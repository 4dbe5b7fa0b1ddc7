// SPDX-License-Identifier: MIT
// Blocks of elements, each byte of the element a row of differences packed in groups of 16.
#include <framework/scene/gltf/meshopt_attributes.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>

namespace lodestir {
namespace {

constexpr std::uint8_t version1 = 0xa1;
constexpr std::size_t groupSize = 16, shortestTail = 24, blockBytes = 8192, largestBlock = 256;

/// How a byte's differences are stored in a block.
enum Control : unsigned { narrow, wide, zeros, verbatim };

/// How a channel of four bytes follows from its predecessor.
enum Channel : unsigned { byByte, byPair, byXor };

/// Differences alternate in sign: 0, -1, 1, -2, ...
template <class T> T unfolded(T v) { return static_cast<T>((v & 1) ? ~(v >> 1) : v >> 1); }

class Decoder {
public:
    Decoder(std::span<const std::byte> stream, std::size_t count, std::size_t stride)
        : stream_(stream), count_(count), stride_(stride), result_(count * stride) {}

    bool decode() {
        const std::size_t tail = stride_ + stride_ / 4, padded = std::max(tail, shortestTail);
        if (stream_.size() < 1 + padded) return false;
        end_ = stream_.size() - padded;
        at_ = 1;
        for (std::size_t i = 0; i < stride_; ++i) previous_[i] = byteAt(stream_.size() - tail + i);
        for (std::size_t i = 0; i < stride_ / 4; ++i) {
            const std::uint8_t channel = byteAt(stream_.size() - stride_ / 4 + i);
            if ((channel & 15) > byXor || ((channel & 15) != byXor && channel > 15)) return false;
            channels_[i] = channel;
        }
        const std::size_t most = std::min((blockBytes / stride_) & ~(groupSize - 1), largestBlock);
        for (std::size_t first = 0; first < count_; first += most) {
            if (!readBlock(std::min(most, count_ - first))) return false;
            follow(first, std::min(most, count_ - first));
        }
        return at_ == end_;
    }
    std::vector<std::byte> take() { return std::move(result_); }

private:
    std::uint8_t byteAt(std::size_t i) const { return static_cast<std::uint8_t>(stream_[i]); }
    bool has(std::size_t bytes) const { return bytes <= end_ - at_; }

    /// The differences of a block, one row for each byte of the element.
    bool readBlock(std::size_t elements) {
        if (!has(stride_ / 4)) return false;
        const std::size_t controls = at_;
        at_ += stride_ / 4;
        for (std::size_t byte = 0; byte < stride_; ++byte) {
            std::uint8_t* row = &rows_[byte * largestBlock];
            std::fill_n(row, largestBlock, std::uint8_t(0));
            const unsigned control = byteAt(controls + byte / 4) >> 2 * (byte % 4) & 3u;
            if (control == zeros) continue;
            if (control == verbatim) {
                if (!has(elements)) return false;
                for (std::size_t i = 0; i < elements; ++i) row[i] = byteAt(at_++);
            } else if (!readGroups(row, (elements + groupSize - 1) / groupSize, control)) {
                return false;
            }
        }
        return true;
    }

    bool readGroups(std::uint8_t* row, std::size_t groups, unsigned control) {
        constexpr std::array<std::array<unsigned, 4>, 2> widths{{{0, 1, 2, 4}, {1, 2, 4, 8}}};
        const std::size_t header = at_;
        if (!has((groups + 3) / 4)) return false;
        at_ += (groups + 3) / 4;
        for (std::size_t g = 0; g < groups; ++g) {
            const unsigned bits = widths[control][byteAt(header + g / 4) >> 2 * (g % 4) & 3u];
            if (!readGroup(row + g * groupSize, bits)) return false;
        }
        return true;
    }

    /// 16 differences of so many bits; one with all bits set stands for a byte behind them.
    bool readGroup(std::uint8_t* out, unsigned bits) {
        if (bits == 0) return true;
        const std::size_t packed = at_;
        if (!has(2 * bits)) return false;
        at_ += 2 * bits;
        const unsigned most = (1u << bits) - 1, perByte = 8 / bits;
        for (unsigned i = 0; i < groupSize; ++i) {
            const unsigned place = i % perByte, shift = bits == 1 ? place : 8 - bits * (place + 1);  // single bits from below, others from above
            unsigned value = byteAt(packed + i / perByte) >> shift & most;
            if (bits < 8 && value == most) {
                if (!has(1)) return false;
                value = byteAt(at_++);
            }
            out[i] = static_cast<std::uint8_t>(value);
        }
        return true;
    }

    /// Adds the differences up to elements.
    void follow(std::size_t first, std::size_t elements) {
        for (std::size_t i = 0; i < elements; ++i) {
            for (std::size_t byte = 0; byte < stride_; byte += 4) {
                const auto row = [&](std::size_t k) { return std::uint32_t(rows_[(byte + k) * largestBlock + i]); };
                std::uint8_t* p = &previous_[byte];
                const std::uint8_t channel = channels_[byte / 4];
                if ((channel & 15) == byByte) {
                    for (std::size_t k = 0; k < 4; ++k) p[k] = static_cast<std::uint8_t>(p[k] + unfolded(static_cast<std::uint8_t>(row(k))));
                } else if ((channel & 15) == byPair) {
                    for (std::size_t k = 0; k < 4; k += 2) {
                        const auto sum = static_cast<std::uint16_t>((p[k] | p[k + 1] << 8) + unfolded(static_cast<std::uint16_t>(row(k) | row(k + 1) << 8)));
                        p[k] = static_cast<std::uint8_t>(sum);
                        p[k + 1] = static_cast<std::uint8_t>(sum >> 8);
                    }
                } else {
                    const std::uint32_t change = std::rotr(row(0) | row(1) << 8 | row(2) << 16 | row(3) << 24, channel >> 4);
                    for (std::size_t k = 0; k < 4; ++k) p[k] = static_cast<std::uint8_t>(p[k] ^ (change >> 8 * k));
                }
            }
            for (std::size_t byte = 0; byte < stride_; ++byte) result_[(first + i) * stride_ + byte] = std::byte(previous_[byte]);
        }
    }

    std::span<const std::byte> stream_;
    std::size_t count_, stride_, at_ = 0, end_ = 0;
    std::vector<std::byte> result_;
    std::array<std::uint8_t, 256> previous_{};
    std::array<std::uint8_t, 64> channels_{};
    std::vector<std::uint8_t> rows_ = std::vector<std::uint8_t>(256 * largestBlock);
};

}  // namespace

bool isMeshoptVersion1(std::span<const std::byte> stream) { return !stream.empty() && static_cast<std::uint8_t>(stream[0]) == version1; }

std::optional<std::vector<std::byte>> decodeMeshoptVersion1(std::span<const std::byte> stream, std::size_t count, std::size_t stride) {
    Decoder decoder(stream, count, stride);
    if (!decoder.decode()) return std::nullopt;
    return decoder.take();
}

}  // namespace lodestir
