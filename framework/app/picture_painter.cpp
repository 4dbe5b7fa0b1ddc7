// SPDX-License-Identifier: MIT
#include <framework/app/picture_painter.h>

#include <framework/app/theme.h>
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
      block_(device, sizeof(PictureBlock), gpu::Memory::upload, "picture: block"),
      colors_(gpu::makeBuffer(device, std::span<const std::uint32_t>(falseColors()), "picture: colours")),
      probe_(device, 16, gpu::Memory::readback, "picture: probe") {
    const gpu::Spirv spirv = gpu::compileShader({.file = shaderFolder() / "view/picture.comp", .folders = {shaderFolder()}, .generated = {}, .defines = {}});
    pipeline_ = gpu::Pipeline(device, spirv, {}, sizeof(VkDeviceAddress), "picture");
    const VkDeviceAddress nothing = 0;
    gpu::runOnce(device, [&](gpu::Commands& commands) { commands.dispatch(pipeline_, std::as_bytes(std::span(&nothing, 1)), 1); });
}

void PicturePainter::prepare(gpu::Commands& commands, const Picture& picture, const TexelLayout& layout, const Look& look, const Rectangle& place, const glm::mat3& toImage,
                             glm::ivec2 probe, bool blueFirst) {
    const std::size_t bytes = std::size_t(place.size.x) * std::size_t(place.size.y) * 4;
    if (target_.size() < bytes) target_ = gpu::Buffer(device_, bytes, gpu::Memory::device, "picture: viewport");
    const glm::mat3 rows = glm::transpose(toImage);
    PictureBlock block{};
    block.texels = picture.texels->address();
    block.target = target_.address();
    block.colors = colors_.address();
    block.probe = probe_.address();
    block.size = picture.extent;
    block.viewport = glm::uvec2(place.size);
    block.row0 = rows[0];
    block.row1 = rows[1];
    block.row2 = rows[2];
    block.probePixel = probe;
    block.stride = layout.stride;
    block.offset = layout.offset;
    block.number = layout.number;
    block.channels = layout.channels;
    block.look = look.look;
    block.pick = look.pick;
    block.curve = look.curve;
    block.swapped = blueFirst ? 1 : 0;
    block.background = word(backgroundColor());
    block.scale = std::exp2(look.exposure);
    block.low = look.low;
    block.high = look.high;
    place_ = place;
    const bool same = std::memcmp(&block, &last_, sizeof block) == 0 && picture.number == number_;
    picture_ = picture;
    layout_ = layout;
    if (same) return;
    last_ = block;
    number_ = picture.number;
    std::memcpy(block_.mapped(), &block, sizeof block);
    const VkDeviceAddress address = block_.address();
    commands.dispatch(pipeline_, std::as_bytes(std::span(&address, 1)), (block.viewport.x + 7) / 8, (block.viewport.y + 7) / 8);
}

void PicturePainter::paint(gpu::Commands& commands, VkImage image) const {
    if (number_ == 0) return;
    VkBufferImageCopy region{};
    region.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
    region.imageOffset = {place_.corner.x, place_.corner.y, 0};
    region.imageExtent = {std::uint32_t(place_.size.x), std::uint32_t(place_.size.y), 1};
    vkCmdCopyBufferToImage(commands.handle(), target_.handle(), image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region);
}

std::optional<PicturePainter::Probe> PicturePainter::probe() const {
    const glm::ivec2 p = last_.probePixel;
    if (number_ == 0 || p.x < 0 || p.y < 0 || p.x >= int(last_.size.x) || p.y >= int(last_.size.y)) return {};
    Probe found{.pixel = p, .bits = {}, .layout = layout_};
    std::memcpy(found.bits.data(), probe_.mapped(), sizeof found.bits);
    return found;
}

}  // namespace lodestir
