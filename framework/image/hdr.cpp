// SPDX-License-Identifier: MIT
// Reads Radiance .hdr files. Not by stb, whose reader never returns from a file that was cut.
#include <framework/core/error.h>
#include <framework/core/files.h>
#include <framework/image/hdr.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string_view>

namespace lodestir {
namespace {

using Rgbe = std::array<unsigned char, 4>;

class HdrReader {
public:
    explicit HdrReader(const Path& path) : path_(path), content_(readText(path)), rest_(content_) {}

    ImageData read() {
        const bool isDownward = readHeader();
        std::vector<Rgbe> line(static_cast<std::size_t>(image_.width));
        const std::size_t lineValues = line.size() * 3;
        for (int row = 0; row < image_.height; ++row) {
            readLine(line);
            image_.values.resize(image_.values.size() + lineValues);  // as lines come: a header may claim anything
            for (int x = 0; x < image_.width; ++x) {
                const Rgbe& pixel = line[static_cast<std::size_t>(x)];
                // Mantissas are 8 bits below the point, the exponent is biased by 128; exponent 0 is black whatever the mantissas are.
                const float scale = pixel[3] == 0 ? 0.0f : std::ldexp(1.0f, pixel[3] - (128 + 8));
                for (int c = 0; c < 3; ++c) image_.at(x, row, c) = pixel[static_cast<std::size_t>(c)] * scale;
            }
        }
        for (int row = 0; !isDownward && row < image_.height / 2; ++row) {
            const auto end = image_.values.end() - row * static_cast<std::ptrdiff_t>(lineValues);
            std::swap_ranges(&image_.at(0, row, 0), &image_.at(0, row, 0) + lineValues, end - static_cast<std::ptrdiff_t>(lineValues));
        }
        return std::move(image_);
    }

private:
    [[noreturn]] void refuse(const std::string& what) const { throw Error(Where{path_.string()}, what); }

    std::string_view take(std::size_t count) {
        if (rest_.size() < count) refuse("is cut: it ends too early");
        const std::string_view taken = rest_.substr(0, count);
        rest_.remove_prefix(count);
        return taken;
    }
    unsigned char takeByte() { return static_cast<unsigned char>(take(1)[0]); }

    std::string_view takeTextLine() {
        const auto end = rest_.find('\n');
        if (end == rest_.npos) refuse("is cut: it ends too early");
        const std::string_view line = rest_.substr(0, end);
        rest_.remove_prefix(end + 1);
        return line;
    }

    /// True when the top line comes first.
    bool readHeader() {
        if (!rest_.starts_with("#?RADIANCE") && !rest_.starts_with("#?RGBE")) refuse("is not a Radiance .hdr file");
        for (std::string_view line = takeTextLine(); !line.empty(); line = takeTextLine()) {
            if (line.starts_with("FORMAT=") && line != "FORMAT=32-bit_rle_rgbe") {
                refuse("has the pixels " + std::string(line) + ", not 32-bit_rle_rgbe");
            }
        }
        const std::string resolution(takeTextLine());
        char direction = 0;
        long long width = 0, height = 0;
        if (std::sscanf(resolution.c_str(), "%cY %9lld +X %9lld", &direction, &height, &width) != 3 ||
            (direction != '-' && direction != '+')) {
            refuse("has the resolution \"" + resolution.substr(0, 40) + "\", not one of the form -Y HEIGHT +X WIDTH");
        }
        checkImageSize(path_, width, height, 3);
        if (static_cast<std::size_t>(height) * 4 > rest_.size()) refuse("is cut: it ends too early");  // a line takes 4 bytes at the least
        image_ = {static_cast<int>(width), static_cast<int>(height), 3, {}};
        return direction == '-';
    }

    void readLine(std::vector<Rgbe>& line) {
        const std::size_t width = line.size();
        const auto byte = [&](std::size_t i) { return i < rest_.size() ? static_cast<unsigned char>(rest_[i]) : 0u; };
        if (width >= 8 && width <= 32767 && byte(0) == 2 && byte(1) == 2 && (byte(2) << 8 | byte(3)) == width) {
            take(4);
            for (std::size_t c = 0; c < 4; ++c) readRuns(line, c);
        } else {
            readPixels(line);
        }
    }

    /// One component of a line: counts above 128 repeat a value count - 128 times, others say how many values follow.
    void readRuns(std::vector<Rgbe>& line, std::size_t c) {
        for (std::size_t x = 0; x < line.size();) {
            const unsigned count = takeByte();
            const bool isRepeat = count > 128;
            const std::size_t length = isRepeat ? count - 128 : count;
            if (length == 0 || length > line.size() - x) refuse("is damaged: a run does not fit its line");
            const std::string_view values = take(isRepeat ? 1 : length);
            for (std::size_t i = 0; i < length; ++i) line[x++][c] = static_cast<unsigned char>(values[isRepeat ? 0 : i]);
        }
    }

    /// The older form: whole pixels; (1, 1, 1, n) repeats the last one, consecutive such pixels being the digits of the count, base 256.
    void readPixels(std::vector<Rgbe>& line) {
        int shift = 0;
        for (std::size_t x = 0; x < line.size();) {
            const std::string_view bytes = take(4);
            Rgbe pixel;
            for (std::size_t c = 0; c < 4; ++c) pixel[c] = static_cast<unsigned char>(bytes[c]);
            if (pixel[0] != 1 || pixel[1] != 1 || pixel[2] != 1) {
                line[x++] = pixel;
                shift = 0;
                continue;
            }
            const std::size_t count = shift < 24 ? static_cast<std::size_t>(pixel[3]) << shift : 0;
            if (x == 0 || shift >= 24 || count > line.size() - x) refuse("is damaged: a run does not fit its line");
            for (std::size_t i = 0; i < count; ++i, ++x) line[x] = line[x - 1];
            shift += 8;
        }
    }

    const Path& path_;
    std::string content_;
    std::string_view rest_;
    ImageData image_;
};

}  // namespace

ImageData readHdr(const Path& path) { return HdrReader(path).read(); }

}  // namespace lodestir
