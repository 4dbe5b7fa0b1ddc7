// SPDX-License-Identifier: MIT
// Reads Radiance .hdr files. Not by stb, whose reader never returns from a file that was cut.
#include <framework/core/error.h>
#include <framework/core/files.h>
#include <framework/core/log.h>
#include <framework/image/hdr.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string_view>

namespace lodestir {
namespace {

using Rgbe = std::array<unsigned char, 4>;

/// x and y of red, green, blue and white: those that Radiance files have unless they say otherwise (File Formats, "Picture"), and Rec. 709's.
/// Both mean a screen's red, green and blue.
constexpr std::array usualPrimaries{0.64, 0.33, 0.29, 0.6, 0.15, 0.06, 1 / 3.0, 1 / 3.0};
constexpr std::array rec709{0.64, 0.33, 0.3, 0.6, 0.15, 0.06, 0.3127, 0.329};

class HdrReader {
public:
    explicit HdrReader(const Path& path) : path_(path), content_(readText(path)), rest_(content_) {}

    ImageData read() {
        const Scan scan = readHeader();
        std::vector<Rgbe> line(scan.length);
        std::vector<float> values;  // as lines come: a header may claim anything
        for (std::size_t row = 0; row < scan.lines; ++row) {
            readLine(line);
            for (const Rgbe& pixel : line) {
                // Mantissas are 8 bits below the point, the exponent is biased by 128; exponent 0 is black whatever the mantissas are.
                const float scale = pixel[3] == 0 ? 0.0f : std::ldexp(1.0f, pixel[3] - (128 + 8));
                for (std::size_t c = 0; c < 3; ++c) values.push_back(static_cast<float>(pixel[c] * scale / stored_[c]));
            }
        }
        return oriented(scan, std::move(values));
    }

private:
    /// How the pixels follow each other: lines of `length` pixels, either of which may run along an axis of the image or against it.
    struct Scan {
        std::size_t lines = 0, length = 0;
        bool alongY = false;  ///< a line is a column
        bool isUpward = false, isLeftward = false;
    };

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
        std::string_view line = rest_.substr(0, end);
        rest_.remove_prefix(end + 1);
        if (line.ends_with('\r')) line.remove_suffix(1);
        return line;
    }

    Scan readHeader() {
        if (!rest_.starts_with("#?RADIANCE") && !rest_.starts_with("#?RGBE")) refuse("is not a Radiance .hdr file");
        for (std::string_view line = takeTextLine(); !line.empty(); line = takeTextLine()) readVariable(line);
        const std::string resolution(takeTextLine());
        char signs[2]{}, axes[2]{};
        long long sizes[2]{};
        const auto isOneOf = [](char c, std::string_view known) { return known.find(c) != known.npos; };
        if (std::sscanf(resolution.c_str(), "%c%c %9lld %c%c %9lld", &signs[0], &axes[0], &sizes[0], &signs[1], &axes[1], &sizes[1]) != 6 ||
            !isOneOf(signs[0], "+-") || !isOneOf(signs[1], "+-") || !isOneOf(axes[0], "XY") || !isOneOf(axes[1], "XY") ||
            axes[0] == axes[1]) {
            refuse("has the resolution \"" + resolution.substr(0, 40) + "\", not one of the form -Y HEIGHT +X WIDTH");
        }
        const bool alongY = axes[1] == 'Y';
        const long long width = sizes[alongY ? 0 : 1], height = sizes[alongY ? 1 : 0];
        checkImageSize(path_, width, height, 3);
        if (static_cast<std::size_t>(sizes[0]) * 4 > rest_.size())
            refuse("is cut: it ends too early");  // a line takes 4 bytes at the least
        return {.lines = static_cast<std::size_t>(sizes[0]),
                .length = static_cast<std::size_t>(sizes[1]),
                .alongY = alongY,
                .isUpward = signs[alongY ? 1 : 0] == '+',
                .isLeftward = signs[alongY ? 0 : 1] == '-'};
    }

    /// A line "NAME=value" of the header. Lines that begin otherwise (comments, commands, those of other pictures, after a tab) say nothing.
    void readVariable(std::string_view line) {
        const std::size_t sign = line.find('=');
        if (sign == line.npos) return;
        const std::string_view name = line.substr(0, sign);
        const std::string value(line.substr(sign + 1));
        if (name == "FORMAT" && value != "32-bit_rle_rgbe") refuse("has the pixels " + std::string(line) + ", not 32-bit_rle_rgbe");
        std::array<double, 8> n{};
        const int count =
            std::sscanf(value.c_str(), "%lf %lf %lf %lf %lf %lf %lf %lf", &n[0], &n[1], &n[2], &n[3], &n[4], &n[5], &n[6], &n[7]);
        if (name == "EXPOSURE") applyFactors(line, count >= 1 ? std::array{n[0], n[0], n[0]} : std::array{0.0, 0.0, 0.0});
        if (name == "COLORCORR") applyFactors(line, count >= 3 ? std::array{n[0], n[1], n[2]} : std::array{0.0, 0.0, 0.0});
        if (name == "PIXASPECT" && !(std::abs(n[0] - 1) < 1e-3))
            log::warn("{}: its pixels are not square ({}); they are taken as if they were", path_.string(), printable(line));
        if (name == "GAMMA" && !(std::abs(n[0] - 1) < 1e-3))
            log::warn("{}: says that its values are not linear ({}); they are taken as if they were", path_.string(), printable(line));
        constexpr std::array<double, 8> unknown{};  // as some programs write
        if (name == "PRIMARIES" && !(count == 8 && (isNear(n, usualPrimaries) || isNear(n, rec709) || n == unknown)))
            log::warn("{}: its primaries are not those of Rec. 709 ({}); its values are taken as if they were", path_.string(),
                      printable(line));
    }

    /// What the header says the pixels were multiplied by; such lines add up.
    void applyFactors(std::string_view line, const std::array<double, 3>& factors) {
        std::array<double, 3> product = stored_;
        for (std::size_t c = 0; c < 3; ++c) product[c] *= factors[c];
        constexpr double least = 1e-30, most = 1e30;  // beyond, no float would be left of the pixels
        if (std::ranges::all_of(product, [](double factor) { return factor >= least && factor <= most; }))
            stored_ = product;
        else
            log::warn("{}: \"{}\" is no factor that pixels can have been multiplied by; it is ignored", path_.string(), printable(line));
    }

    static bool isNear(const std::array<double, 8>& a, const std::array<double, 8>& b) {
        return std::ranges::equal(a, b, [](double x, double y) { return std::abs(x - y) < 2e-3; });
    }

    /// The start of a line out of the file, fit for a terminal.
    static std::string printable(std::string_view line) {
        std::string text(line.substr(0, 80));
        std::ranges::replace_if(
            text, [](char c) { return c < ' ' || c > '~'; }, '?');
        return text;
    }

    /// The top line first, each from the left.
    static ImageData oriented(const Scan& scan, std::vector<float> values) {
        const auto width = static_cast<int>(scan.alongY ? scan.lines : scan.length),
                   height = static_cast<int>(scan.alongY ? scan.length : scan.lines);
        if (!scan.alongY && !scan.isUpward && !scan.isLeftward) return {width, height, 3, std::move(values)};
        ImageData image = makeImage(width, height, 3);
        for (std::size_t line = 0; line < scan.lines; ++line) {
            for (std::size_t i = 0; i < scan.length; ++i) {
                const auto x = static_cast<int>(scan.alongY ? line : i), y = static_cast<int>(scan.alongY ? i : line);
                std::copy_n(&values[(line * scan.length + i) * 3], 3,
                            &image.at(scan.isLeftward ? width - 1 - x : x, scan.isUpward ? height - 1 - y : y, 0));
            }
        }
        return image;
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
    std::array<double, 3> stored_{1, 1, 1};  ///< what the pixels' red, green and blue were multiplied by
};

}  // namespace

ImageData readHdr(const Path& path) { return HdrReader(path).read(); }

}  // namespace lodestir
