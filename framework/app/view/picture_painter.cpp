// SPDX-License-Identifier: MIT
#include <framework/app/view/picture_painter.h>

#include <framework/app/view/theme.h>
#include <framework/gpu/shader.h>
#include <framework/image/color_map.h>
#include <framework/image/srgb.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace lodestir {
namespace {

std::uint32_t word(const std::array<float, 3>& color) {
    std::uint32_t bits = 0xff000000u;
    for (std::size_t c = 0; c < 3; ++c) bits |= std::uint32_t(std::clamp(color[c], 0.0f, 1.0f) * 255 + 0.5f) << (8 * c);
    return bits;
}

std::vector<std::uint32_t> falseColors() {
    ImageData ramp = makeImage(256, 1, 1);
    for (int i = 0; i < 256; ++i) ramp.at(i, 0, 0) = float(i) / 255;
    const ImageData colors = colorMap(ramp, 1);
    std::vector<std::uint32_t> words;
    for (int i = 0; i < 256; ++i) words.push_back(word({encodeSrgb(colors.at(i, 0, 0)), encodeSrgb(colors.at(i, 0, 1)), encodeSrgb(colors.at(i, 0, 2))}));
    return words;
}

}  // namespace

PicturePainter::PicturePainter(const gpu::Device& device)
    : device_(device),
      ramp_(gpu::makeBuffer(device, std::span<const std::uint32_t>(falseColors()), "picture: false colours")),
      probe_(device, 16, gpu::Memory::readback, "picture: probe") {
    const auto make = [&](const char* name, std::uint32_t pushBytes) {
        const gpu::Spirv spirv = gpu::compileShader({.file = shaderFolder() / "view" / name, .folders = {shaderFolder()}, .generated = {}, .defines = {}});
        gpu::Pipeline pipeline(device, spirv, {}, pushBytes, name);
        const std::vector<std::byte> nothing(pushBytes);  // an image without pixels: CPU drivers compile at the first dispatch
        gpu::runOnce(device, [&](gpu::Commands& commands) { commands.dispatch(pipeline, nothing, 1); });
        return pipeline;
    };
    color_ = make("color_texels.comp", sizeof(ColorTexels));
    placement_ = make("place_picture.comp", sizeof(PlacePicture));
}

void PicturePainter::prepare(gpu::Commands& commands, const Picture& picture, const Picture* minus, const TexelLayout& layout, const Look& look,
                             const Rectangle& place, const glm::mat3& toImage, glm::ivec2 probe, bool blueFirst) {
    const std::size_t texels = std::size_t(picture.extent.x) * picture.extent.y * 4, pixels = std::size_t(place.size.x) * std::size_t(place.size.y) * 4;
    if (colors_.size() < texels) colors_ = gpu::Buffer(device_, texels, gpu::Memory::device, "picture: colours");
    if (target_.size() < pixels) target_ = gpu::Buffer(device_, pixels, gpu::Memory::device, "picture: viewport");

    ColorTexels color{};
    color.texels = picture.texels->address();
    color.minus = minus ? minus->texels->address() : 0;
    color.colors = colors_.address();
    color.ramp = ramp_.address();
    color.probe = probe_.address();
    color.size = picture.extent;
    color.probePixel = colored_.probePixel;
    color.stride = layout.stride;
    color.offset = layout.offset;
    color.number = layout.number;
    color.channels = layout.channels;
    color.look = look.look;
    color.pick = look.pick;
    color.curve = look.curve;
    color.swapped = blueFirst ? 1 : 0;
    color.scale = std::exp2(look.exposure);
    color.low = look.low;
    color.high = look.high;
    const bool recolor = picture.number != picture_.number || std::memcmp(&color, &colored_, sizeof color) != 0;
    const bool reprobe = recolor || probe != colored_.probePixel;
    color.probePixel = probe;
    colored_ = color;
    picture_ = picture;
    minus_ = minus ? *minus : Picture();
    layout_ = layout;
    if (reprobe) {
        color.probeOnly = recolor ? 0 : 1;
        const glm::uvec2 groups = recolor ? (picture.extent + 7u) / 8u : glm::uvec2(1);
        commands.dispatch(color_, std::as_bytes(std::span(&color, 1)), groups.x, groups.y);
    }

    const glm::mat3 rows = glm::transpose(toImage);
    PlacePicture placed{};
    placed.colors = colors_.address();
    placed.target = target_.address();
    placed.size = picture.extent;
    placed.viewport = glm::uvec2(place.size);
    placed.row0 = rows[0];
    placed.row1 = rows[1];
    placed.row2 = rows[2];
    const glm::vec3 middle = toImage * glm::vec3(0.5f * glm::vec2(place.size), 1), beside = middle + toImage[0];
    const float step = std::abs(beside.x / beside.z - middle.x / middle.z);  // pixels of the image in one of the window
    // Scaled up a little and by no whole number, pixels would be wide and narrow ones in turn.
    const float times = 1 / std::max(step, 1e-6f);
    const bool ragged = times > 1.01f && times < 8 && std::abs(times - std::round(times)) > 0.01f;
    placed.samples = ragged ? 0 : std::uint32_t(std::clamp(std::ceil(step - 0.25f), 1.0f, 4.0f));
    placed.background = word(backgroundColor());
    if (blueFirst) placed.background = (placed.background & 0xff00ff00u) | (placed.background & 0xff) << 16 | (placed.background >> 16 & 0xff);
    place_ = place;
    if (!recolor && std::memcmp(&placed, &placed_, sizeof placed) == 0) return;
    placed_ = placed;
    commands.barrier();
    commands.dispatch(placement_, std::as_bytes(std::span(&placed, 1)), (placed.viewport.x + 7) / 8, (placed.viewport.y + 7) / 8);
}

void PicturePainter::paint(gpu::Commands& commands, VkImage image, float from, float to) const {
    const auto column = [&](float share) { return int(share * float(place_.size.x) + 0.5f); };
    const int first = column(from), width = column(to) - first;
    if (!picture_.texels || width <= 0) return;
    VkBufferImageCopy region{};
    region.bufferOffset = 4 * VkDeviceSize(first);
    region.bufferRowLength = std::uint32_t(place_.size.x);
    region.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
    region.imageOffset = {place_.corner.x + first, place_.corner.y, 0};
    region.imageExtent = {std::uint32_t(width), std::uint32_t(place_.size.y), 1};
    vkCmdCopyBufferToImage(commands.handle(), target_.handle(), image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region);
}

std::optional<PicturePainter::Probe> PicturePainter::probe() const {
    const glm::ivec2 p = colored_.probePixel;
    if (!picture_.texels || p.x < 0 || p.y < 0 || p.x >= int(picture_.extent.x) || p.y >= int(picture_.extent.y)) return {};
    Probe found{.pixel = p, .bits = {}, .layout = layout_};
    std::memcpy(found.bits.data(), probe_.mapped(), sizeof found.bits);
    return found;
}

}  // namespace lodestir
