// SPDX-License-Identifier: MIT
// An image file as the output of a pass: a reference beside what is rendered, a backdrop, a mask.
#include <framework/pass/image.h>
#include <framework/pass/pass.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>

using namespace lodestir;

namespace {

/// Grey in all three; opacity is 1 where the file has none.
std::array<float, 4> rgbaOf(const ImageData& image, int x, int y) {
    const auto c = [&](int channel) { return image.at(x, y, channel); };
    const int colors = image.channels - (image.hasOpacity ? 1 : 0);
    const float opacity = image.hasOpacity ? c(colors) : 1;
    if (colors == 1) return {c(0), c(0), c(0), opacity};
    return {c(0), c(1), colors > 2 ? c(2) : 0, opacity};
}

/// Where the centre of pixel `i` of `count` falls among `wanted` pixels' worth of another image: two pixels and the share of the second.
struct Tap {
    int first, second;
    float share;
    Tap(int i, int count, int wanted) {
        const float at = (float(i) + 0.5f) * float(wanted) / float(count) - 0.5f, floor = std::floor(at);
        first = std::clamp(int(floor), 0, wanted - 1);
        second = std::clamp(int(floor) + 1, 0, wanted - 1);
        share = at - floor;
    }
};

std::vector<std::array<float, 4>> texelsOf(const ImageData& image, glm::uvec2 size) {
    std::vector<std::array<float, 4>> texels;
    texels.reserve(std::size_t(size.x) * size.y);
    for (int y = 0; y < int(size.y); ++y) {
        const Tap v(y, int(size.y), image.height);
        for (int x = 0; x < int(size.x); ++x) {
            const Tap u(x, int(size.x), image.width);
            const auto a = rgbaOf(image, u.first, v.first), b = rgbaOf(image, u.second, v.first), c = rgbaOf(image, u.first, v.second),
                       d = rgbaOf(image, u.second, v.second);
            std::array<float, 4>& texel = texels.emplace_back();
            for (std::size_t i = 0; i < 4; ++i)
                texel[i] = std::lerp(std::lerp(a[i], b[i], u.share), std::lerp(c[i], d[i], u.share), v.share);
        }
    }
    return texels;
}

}  // namespace

struct ImageLoader final : Pass {
    Out<Image>                   image{this, "image",
                                       "the file's colour, linear (PNG: decoded from sRGB); its opacity, or 1, in the fourth channel",
                                       Format::rgba32f};
    Param<std::filesystem::path> file{this, "file", "OpenEXR, PNG, JPEG or Radiance .hdr"};
    Param<bool>                  resample{this, "resample", false,
                                          "stretch an image of another size than the frame (bilinear) instead of refusing it"};
    ImageLoader() { cadence = Cadence::onChange; }

    void execute(Frame& frame) override {
        const std::filesystem::path path = file;
        if (path.empty()) throw Error("an image_loader has no file to load", "set its \"file\"");
        const ImageData read = readImage(path);
        const glm::uvec2 size = frame.sizeOf(image);
        if (!resample && (read.width != int(size.x) || read.height != int(size.y)))
            throw Error(Where{path.string()},
                        "has " + std::to_string(read.width) + " x " + std::to_string(read.height) + " pixels, the frame " +
                            std::to_string(size.x) + " x " + std::to_string(size.y),
                        "render with --size " + std::to_string(read.width) + "x" + std::to_string(read.height) + ", or set \"resample\"");
        const auto texels = texelsOf(read, size);
        frame.upload(image, std::as_bytes(std::span(texels)));
    }
};
LODESTIR_PASS(ImageLoader, "", "Loads an image file; once, and again when it is set to another.")
