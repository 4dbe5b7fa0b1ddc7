// SPDX-License-Identifier: MIT
#include <framework/app/view/compared_sides.h>

#include <framework/image/image_file.h>

#include <fmt/format.h>

#include <algorithm>

namespace lodestir {
namespace {

/// As the painter and other pictures have colour: four floats a texel. Grey stays one number.
ImageData asTexels(const ImageData& image) {
    if (image.channels != 3) return firstChannels(image, std::min(image.channels, 4));
    ImageData texels = makeImage(image.width, image.height, 4);
    texels.hasOpacity = true;
    for (std::size_t i = 0; i < image.pixelCount(); ++i) {
        std::copy_n(image.values.begin() + std::ptrdiff_t(3 * i), 3, texels.values.begin() + std::ptrdiff_t(4 * i));
        texels.values[4 * i + 3] = 1;
    }
    return texels;
}

TexelLayout floatLayout(int channels) { return {.stride = 4 * std::uint32_t(channels), .channels = std::uint32_t(channels)}; }

}  // namespace

void ComparedSides::keep(const Picture& picture, const std::string& what, SideGraph graph) {
    live_.reset();
    kept_ = Kept{picture, what, std::move(graph)};
    forget();
}

void ComparedSides::run(std::unique_ptr<LiveSide> live) {
    kept_.reset();
    live_ = std::move(live);
    forget();
}

void ComparedSides::read(const Path& file, glm::uvec2 size, Captures& captures) {
    const ImageData image = asTexels(readImage(file));
    if (glm::uvec2(image.width, image.height) != size)
        throw Error(Where{file.string()}, fmt::format("the image is {}x{}, frames are {}x{}", image.width, image.height, size.x, size.y),
                    fmt::format("see --size {}x{}", image.width, image.height));
    image_ = Image{image, captures.upload(image, file.filename().string())};
    forget();
}

void ComparedSides::release() {
    if (!live_ && !kept_) image_.reset();
    live_.reset();
    kept_.reset();
    forget();
}

/// Of what was measured of another A.
void ComparedSides::forget() {
    error_.clear();
    measured_ = 0;
}

SideA ComparedSides::a() const {
    if (live_) {
        const SideGraph& graph = live_->graph();
        return {SideA::Kind::live, pictureName(graph.file, graph.made.variant.value_or(""), live_->picture()), live_->picture(), graph.layout,
                live_->milliseconds()};
    }
    if (kept_) return {SideA::Kind::kept, kept_->what, kept_->picture, kept_->graph.layout};
    if (image_) return {SideA::Kind::image, image_->picture.port, image_->picture, floatLayout(image_->image.channels)};
    return {};
}

void ComparedSides::measure(const Picture& b, const TexelLayout& layout, std::uint32_t pick, std::uint32_t frames, bool always, Captures& captures) {
    const SideA a = this->a();
    if (!a.picture.texels || !b.texels || b.number == measured_ || !(always || error_.due())) return;
    if (b.port != port_ || layout != layout_) error_.restart();
    measured_ = b.number;
    port_ = b.port;
    layout_ = layout;
    const ImageData now = imageOf(captures.bytesOf(b), b.extent, layout);
    if (a.kind == SideA::Kind::image) return error_.measure(frames, image_->image, now, nullptr, a.what, pick);
    const ImageData other = imageOf(captures.bytesOf(a.picture), a.picture.extent, a.layout);
    error_.measure(frames, other, now, image_ ? &image_->image : nullptr, image_ ? image_->picture.port : "A", pick);
}

}  // namespace lodestir
