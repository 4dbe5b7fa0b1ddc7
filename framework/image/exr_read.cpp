// SPDX-License-Identifier: MIT
// Reads OpenEXR files.
#include <framework/core/error.h>
#include <framework/core/files.h>
#include <framework/core/log.h>
#include <framework/image/exr.h>
#include <framework/image/exr_stream.h>

#include <ImfChannelList.h>
#include <ImfChromaticities.h>
#include <ImfFrameBuffer.h>
#include <ImfInputPart.h>
#include <ImfMultiPartInputFile.h>
#include <ImfPartType.h>
#include <ImfRgbaFile.h>
#include <ImfStandardAttributes.h>
#include <ImfStringAttribute.h>
#include <ImfTileDescription.h>

#include <algorithm>
#include <new>

namespace lodestir {
namespace {

using Imath::Box2i;

long long widthOf(const Box2i& box) { return static_cast<long long>(box.max.x) - box.min.x + 1; }
long long heightOf(const Box2i& box) { return static_cast<long long>(box.max.y) - box.min.y + 1; }

/// Damaged files have damaged names, which messages repeat: no control character of theirs should reach a terminal.
[[noreturn]] void refuse(const Path& path, std::string what, std::string hint = {}) {
    std::ranges::replace_if(
        what, [](char c) { return c < ' ' || c > '~'; }, '?');
    throw Error(Where{path.string()}, std::move(what), std::move(hint));
}

bool isLuminanceChroma(const Imf::ChannelList& channels) {
    return channels.findChannel("Y") && channels.findChannel("RY") && channels.findChannel("BY");
}

std::vector<std::string> chooseChannels(const Imf::ChannelList& channels) {
    std::vector<std::string> names;
    const auto addIfThere = [&](const char* name) {
        if (channels.findChannel(name)) names.emplace_back(name);
    };
    for (const char* name : {"R", "G", "B"}) addIfThere(name);
    if (names.empty()) {
        for (auto channel = channels.begin(); channel != channels.end(); ++channel) {
            if (std::string(channel.name()) != "A") names.emplace_back(channel.name());
        }
    }
    addIfThere("A");
    return names;
}

/// What would make OpenEXR take memory out of all proportion, or read what an image cannot hold.
void checkHeader(const Path& path, const Imf::Header& header, std::size_t channelCount) {
    if (header.hasType() && Imf::isDeepData(header.type())) refuse(path, "is a deep image, which this program does not read");
    const auto channels = static_cast<long long>(channelCount);
    for (const Box2i& window : {header.dataWindow(), header.displayWindow()}) {
        checkImageSize(path, widthOf(window), heightOf(window), channels);
    }
    if (header.hasTileDescription()) {
        const Imf::TileDescription& tiles = header.tileDescription();
        checkImageSize(path, tiles.xSize, tiles.ySize, channels);
    }
    // Primaries other than Rec. 709 would need a conversion; nobody should find out from the colours.
    if (Imf::hasChromaticities(header)) {
        const Imf::Chromaticities given = Imf::chromaticities(header), expected;
        const auto differ = [](Imath::V2f a, Imath::V2f b) { return (a - b).length() > 1e-3f; };
        if (differ(given.red, expected.red) || differ(given.green, expected.green) || differ(given.blue, expected.blue)) {
            log::warn("{}: its primaries are not those of Rec. 709; its values are taken as if they were", path.string());
        }
    }
}

/// The data window, all chosen channels as floats.
ImageData readData(const Path& path, Imf::MultiPartInputFile& file, const std::vector<std::string>& names) {
    Imf::InputPart part(file, 0);
    const Imf::Header& header = part.header();
    const Box2i window = header.dataWindow();
    ImageData data = makeImage(static_cast<int>(widthOf(window)), static_cast<int>(heightOf(window)), static_cast<int>(names.size()));
    Imf::FrameBuffer target;
    for (std::size_t i = 0; i < names.size(); ++i) {
        const Imf::Channel& channel = header.channels()[names[i].c_str()];
        if (channel.xSampling != 1 || channel.ySampling != 1) {
            refuse(path, "the channel \"" + names[i] + "\" is subsampled, which only luminance and chroma (Y, RY, BY) may be");
        }
        const std::size_t pixelStride = names.size() * sizeof(float);
        target.insert(names[i], Imf::Slice::Make(Imf::FLOAT, data.values.data() + i, window, pixelStride,
                                                 pixelStride * static_cast<std::size_t>(data.width)));
    }
    part.setFrameBuffer(target);
    part.readPixels(window.min.y, window.max.y);
    if (!part.isComplete()) refuse(path, "is incomplete: some of its pixels were never written");
    return data;
}

/// Luminance and subsampled chroma, made R, G, B by OpenEXR.
ImageData readLuminanceChroma(std::span<const std::byte> bytes, const Path& path, bool hasAlpha) {
    ExrInput stream(bytes, path.filename().string());
    Imf::RgbaInputFile file(stream);
    const Box2i window = file.dataWindow();
    ImageData data = makeImage(static_cast<int>(widthOf(window)), static_cast<int>(heightOf(window)), hasAlpha ? 4 : 3);
    std::vector<Imf::Rgba> pixels(data.pixelCount());
    const auto width = static_cast<std::ptrdiff_t>(data.width);
    file.setFrameBuffer(pixels.data() - window.min.x - window.min.y * width, 1, static_cast<std::size_t>(width));
    file.readPixels(window.min.y, window.max.y);
    if (!file.isComplete()) refuse(path, "is incomplete: some of its pixels were never written");
    float* value = data.values.data();
    for (const Imf::Rgba& pixel : pixels) {
        for (const half channel : {pixel.r, pixel.g, pixel.b}) *value++ = channel;
        if (hasAlpha) *value++ = pixel.a;
    }
    return data;
}

/// Places the data window into the display window.
ImageData frame(ImageData data, const Box2i& dataWindow, const Box2i& displayWindow) {
    if (dataWindow == displayWindow) return data;
    ImageData image = makeImage(static_cast<int>(widthOf(displayWindow)), static_cast<int>(heightOf(displayWindow)), data.channels);
    const Box2i both(Imath::V2i(std::max(dataWindow.min.x, displayWindow.min.x), std::max(dataWindow.min.y, displayWindow.min.y)),
                     Imath::V2i(std::min(dataWindow.max.x, displayWindow.max.x), std::min(dataWindow.max.y, displayWindow.max.y)));
    if (both.isEmpty()) return image;
    for (int y = both.min.y; y <= both.max.y; ++y) {
        std::copy_n(&data.at(both.min.x - dataWindow.min.x, y - dataWindow.min.y, 0), widthOf(both) * data.channels,
                    &image.at(both.min.x - displayWindow.min.x, y - displayWindow.min.y, 0));
    }
    return image;
}

ExrFile decode(std::span<const std::byte> bytes, const Path& path) {
    ExrInput stream(bytes, path.filename().string());
    Imf::MultiPartInputFile file(stream, 0, /* reconstructChunkOffsetTable = */ false);
    const Imf::Header& header = file.header(0);

    ExrFile result;
    result.channels = chooseChannels(header.channels());
    checkHeader(path, header, result.channels.size());
    for (auto attribute = header.begin(); attribute != header.end(); ++attribute) {
        const auto* text = dynamic_cast<const Imf::StringAttribute*>(&attribute.attribute());
        if (text && std::string(attribute.name()) != "type") {  // OpenEXR adds the layout of the file under this name
            result.attributes[attribute.name()] = text->value();
        }
    }
    if (isLuminanceChroma(header.channels())) {
        const bool hasAlpha = header.channels().findChannel("A") != nullptr;
        result.channels = {"R", "G", "B"};
        if (hasAlpha) result.channels.emplace_back("A");
        result.image = readLuminanceChroma(bytes, path, hasAlpha);
    } else {
        result.image = readData(path, file, result.channels);
    }
    result.image = frame(std::move(result.image), header.dataWindow(), header.displayWindow());
    return result;
}

}  // namespace

ExrFile readExrFile(const Path& path) {
    const std::vector<std::byte> bytes = readBytes(path);
    constexpr std::byte magic[] = {std::byte{0x76}, std::byte{0x2f}, std::byte{0x31}, std::byte{0x01}};
    if (bytes.size() < 4 || !std::equal(magic, magic + 4, bytes.begin())) refuse(path, "is not an OpenEXR file");
    try {
        return decode(bytes, path);
    } catch (const Error&) {
        throw;
    } catch (const std::bad_alloc&) {
        refuse(path, "asks for more memory than there is", "the file may be damaged");
    } catch (const std::exception& error) {
        refuse(path, std::string("is damaged or cut: ") + error.what());
    }
}

ImageData readExr(const Path& path) { return readExrFile(path).image; }

}  // namespace lodestir
