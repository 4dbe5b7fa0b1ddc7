// SPDX-License-Identifier: MIT
// Reads OpenEXR files.
#include <framework/core/error.h>
#include <framework/core/files.h>
#include <framework/core/log.h>
#include <framework/image/exr.h>
#include <framework/image/exr_attributes.h>
#include <framework/image/exr_layers.h>
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
#include <fmt/ranges.h>

#include <algorithm>
#include <new>

namespace lodestir {
namespace {

using Imath::Box2i;

long long widthOf(const Box2i& box) { return static_cast<long long>(box.max.x) - box.min.x + 1; }
long long heightOf(const Box2i& box) { return static_cast<long long>(box.max.y) - box.min.y + 1; }

/// Damaged files have damaged names, which messages repeat: no control character of theirs should reach a terminal.
std::string printable(std::string text) {
    std::ranges::replace_if(
        text, [](char c) { return c < ' ' || c > '~'; }, '?');
    return text;
}

[[noreturn]] void refuse(const Path& path, std::string what, std::string hint = {}) {
    throw Error(Where{path.string()}, printable(std::move(what)), std::move(hint));
}

/// OpenEXR holds as many lines as it compresses together, up to 256, or a row of tiles, of all channels, wanted or not.
void checkBuffers(const Path& path, const Imf::Header& header) {
    constexpr long long lineLimit = 1ll << 22, tileLimit = 1ll << 28, tileRowLimit = 1ll << 30;  // bytes
    const long long width = std::max(widthOf(header.dataWindow()), 0ll);
    long long channels = 0;
    for (auto channel = header.channels().begin(); channel != header.channels().end(); ++channel) ++channels;
    const long long pixel = channels * static_cast<long long>(sizeof(float)), line = width * pixel;
    if (line > lineLimit) {
        refuse(path, "claims lines of " + std::to_string(line) + " bytes, which is not a size this program reads", "the file may be damaged");
    }
    if (!header.hasTileDescription()) return;
    const Imf::TileDescription& tiles = header.tileDescription();
    const long long tile = static_cast<long long>(tiles.xSize) * tiles.ySize * pixel;
    if (tile > tileLimit || line * tiles.ySize > tileRowLimit) {
        refuse(path,
               "claims tiles of " + std::to_string(tiles.xSize) + " x " + std::to_string(tiles.ySize) +
                   " pixels, which is not a size this program reads",
               "the file may be damaged");
    }
}

/// Would so large an image need so much better a compression than any real one that it is to be read once on trial, without being kept?
bool isSuspicious(const ImageData& image, std::size_t bytes) {
    constexpr std::size_t usual = std::size_t(1) << 20, ratio = 64;  // values; values a byte
    const std::size_t values = image.pixelCount() * static_cast<std::size_t>(image.channels);
    return values > usual && values / ratio > bytes;
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
    checkBuffers(path, header);
    // Primaries other than Rec. 709 would need a conversion; nobody should find out from the colours.
    if (Imf::hasChromaticities(header)) {
        const Imf::Chromaticities given = Imf::chromaticities(header), expected;
        const auto differ = [](Imath::V2f a, Imath::V2f b) { return (a - b).length() > 1e-3f; };
        if (differ(given.red, expected.red) || differ(given.green, expected.green) || differ(given.blue, expected.blue)) {
            log::warn("{}: its primaries are not those of Rec. 709; its values are taken as if they were", path.string());
        }
    }
}

/// Where OpenEXR would find pixel (0, 0), which may lie far outside: no pointer could be led there.
char* origin(void* first, const Box2i& window, std::size_t pixelStride, std::size_t lineStride) {
    const auto x = static_cast<std::uintptr_t>(std::intptr_t(window.min.x)), y = static_cast<std::uintptr_t>(std::intptr_t(window.min.y));
    return reinterpret_cast<char*>(reinterpret_cast<std::uintptr_t>(first) - x * pixelStride - y * lineStride);
}

/// The data window, all chosen channels as floats.
ImageData readData(const Path& path, std::size_t bytes, Imf::MultiPartInputFile& file, const ExrLayer& layer) {
    const std::vector<std::string>& names = layer.channels;
    Imf::InputPart part(file, static_cast<int>(layer.part));
    const Imf::Header& header = part.header();
    const Box2i window = header.dataWindow();
    for (const std::string& name : names) {
        const Imf::Channel& channel = header.channels()[name.c_str()];
        if (channel.xSampling != 1 || channel.ySampling != 1) {
            refuse(path, "the channel \"" + name + "\" is subsampled, which only luminance and chroma (Y, RY, BY) may be");
        }
    }
    if (!part.isComplete()) refuse(path, "is incomplete: some of its pixels were never written");
    ImageData data{
        static_cast<int>(widthOf(window)), static_cast<int>(heightOf(window)), static_cast<int>(names.size()), {}, layer.hasOpacity};
    const std::size_t pixelStride = names.size() * sizeof(float), lineStride = pixelStride * static_cast<std::size_t>(data.width);
    const auto readInto = [&](std::vector<float>& values, std::size_t stride) {
        Imf::FrameBuffer target;
        char* first = origin(values.data(), window, pixelStride, stride);
        for (std::size_t i = 0; i < names.size(); ++i)
            target.insert(names[i], Imf::Slice(Imf::FLOAT, first + i * sizeof(float), pixelStride, stride));
        part.setFrameBuffer(target);
        part.readPixels(window.min.y, window.max.y);
    };
    if (isSuspicious(data, bytes)) {
        std::vector<float> line(lineStride / sizeof(float));
        readInto(line, 0);  // all lines over one another
    }
    data.values.resize(data.pixelCount() * names.size());
    readInto(data.values, lineStride);
    return data;
}

/// Luminance and subsampled chroma, made R, G, B by OpenEXR.
ImageData readLuminanceChroma(std::span<const std::byte> bytes, const Path& path, const ExrLayer& layer) {
    ExrInput stream(bytes, path.filename().string());
    Imf::RgbaInputFile file(stream, layer.prefix);
    const Box2i window = file.dataWindow();
    if (!file.isComplete()) refuse(path, "is incomplete: some of its pixels were never written");
    ImageData data{static_cast<int>(widthOf(window)), static_cast<int>(heightOf(window)), layer.hasOpacity ? 4 : 3, {}, layer.hasOpacity};
    std::vector<Imf::Rgba> pixels;
    const auto readInto = [&](std::size_t lines, std::size_t stride) {
        pixels.resize(lines * static_cast<std::size_t>(data.width));
        char* first = origin(pixels.data(), window, sizeof(Imf::Rgba), stride * sizeof(Imf::Rgba));
        file.setFrameBuffer(reinterpret_cast<Imf::Rgba*>(first), 1, stride);
        file.readPixels(window.min.y, window.max.y);
    };
    if (isSuspicious(data, bytes.size())) readInto(1, 0);  // all lines over one another
    readInto(static_cast<std::size_t>(data.height), static_cast<std::size_t>(data.width));
    data.values.resize(data.pixelCount() * static_cast<std::size_t>(data.channels));
    float* value = data.values.data();
    for (const Imf::Rgba& pixel : pixels) {
        for (const half channel : {pixel.r, pixel.g, pixel.b}) *value++ = channel;
        if (layer.hasOpacity) *value++ = pixel.a;
    }
    return data;
}

/// Places the data window into the display window.
ImageData frame(ImageData data, const Box2i& dataWindow, const Box2i& displayWindow) {
    if (dataWindow == displayWindow) return data;
    ImageData image = makeImage(static_cast<int>(widthOf(displayWindow)), static_cast<int>(heightOf(displayWindow)), data.channels);
    image.hasOpacity = data.hasOpacity;
    const Box2i both(Imath::V2i(std::max(dataWindow.min.x, displayWindow.min.x), std::max(dataWindow.min.y, displayWindow.min.y)),
                     Imath::V2i(std::min(dataWindow.max.x, displayWindow.max.x), std::min(dataWindow.max.y, displayWindow.max.y)));
    if (both.isEmpty()) return image;
    for (int y = both.min.y; y <= both.max.y; ++y) {
        std::copy_n(&data.at(both.min.x - dataWindow.min.x, y - dataWindow.min.y, 0), widthOf(both) * data.channels,
                    &image.at(both.min.x - displayWindow.min.x, y - displayWindow.min.y, 0));
    }
    return image;
}

std::vector<ExrPart> partsOf(const Imf::MultiPartInputFile& file) {
    std::vector<ExrPart> parts(static_cast<std::size_t>(file.parts()));
    for (int i = 0; i < file.parts(); ++i) {
        const Imf::Header& header = file.header(i);
        if (header.hasType() && Imf::isDeepData(header.type())) continue;
        ExrPart& part = parts[static_cast<std::size_t>(i)];
        if (header.hasName()) part.name = header.name();
        for (auto channel = header.channels().begin(); channel != header.channels().end(); ++channel)
            part.channels.emplace_back(channel.name());
    }
    return parts;
}

/// The first few of a file's names, fit for a terminal.
std::string listed(const std::vector<std::string>& names) {
    constexpr std::size_t most = 8;
    const auto end = names.begin() + static_cast<std::ptrdiff_t>(std::min(most, names.size()));
    return printable(fmt::format("{}{}", fmt::join(names.begin(), end, ", "), names.size() > most ? ", ..." : ""));
}

/// Nobody should find out from the colours which channels were taken.
void tellChoice(const Path& path, const ExrLayer& layer) {
    const std::size_t colors = layer.channels.size() - (layer.hasOpacity ? 1 : 0);
    if (layer.content == ExrContent::unknown && colors > 1)
        log::warn("{}: none of its channels is known as colour; they are taken in the order {}", path.string(), listed(layer.channels));
    if (layer.others.empty()) return;
    log::note("{}: takes {} of {} layers; the others: {}", path.string(),
              layer.name.empty() ? "the unnamed one" : printable("\"" + layer.name + "\""), layer.others.size() + 1, listed(layer.others));
}

/// Opens a file and reads what `choose` makes of its parts.
template <class Choose> ExrFile decode(std::span<const std::byte> bytes, const Path& path, const Choose& choose) {
    ExrInput stream(bytes, path.filename().string());
    Imf::MultiPartInputFile file(stream, 0, /* reconstructChunkOffsetTable = */ false);
    const ExrLayer layer = choose(partsOf(file));
    const Imf::Header& header = file.header(static_cast<int>(layer.part));
    checkHeader(path, header, layer.channels.size());

    ExrFile result;
    result.channels = layer.channels;
    for (auto attribute = header.begin(); attribute != header.end(); ++attribute) {
        const auto* text = dynamic_cast<const Imf::StringAttribute*>(&attribute.attribute());
        if (text && std::string(attribute.name()) != "type") {  // OpenEXR adds the layout of the file under this name
            result.attributes[attribute.name()] = text->value();
        }
    }
    result.image =
        layer.content == ExrContent::luminanceChroma ? readLuminanceChroma(bytes, path, layer) : readData(path, bytes.size(), file, layer);
    result.image = frame(std::move(result.image), header.dataWindow(), header.displayWindow());
    return result;
}

template <class Choose> ExrFile readFile(const Path& path, const Choose& choose) {
    const std::vector<std::byte> bytes = readBytes(path);
    constexpr std::byte magic[] = {std::byte{0x76}, std::byte{0x2f}, std::byte{0x31}, std::byte{0x01}};
    if (bytes.size() < 4 || !std::equal(magic, magic + 4, bytes.begin())) refuse(path, "is not an OpenEXR file");
    if (const auto flaw = attributeFlaw(bytes)) refuse(path, "is damaged or cut: " + *flaw);
    try {
        return decode(bytes, path, choose);
    } catch (const Error&) {
        throw;
    } catch (const std::bad_alloc&) {
        refuse(path, "asks for more memory than there is", "the file may be damaged");
    } catch (const std::exception& error) {
        refuse(path, std::string("is damaged or cut: ") + error.what());
    }
}

}  // namespace

ExrFile readExrFile(const Path& path) {
    ExrLayer layer;
    ExrFile file = readFile(path, [&](const std::vector<ExrPart>& parts) { return layer = chooseLayer(parts); });
    tellChoice(path, layer);
    return file;
}

ExrFile readExrChannels(const Path& path, const std::vector<std::string>& names) {
    return readFile(path, [&](const std::vector<ExrPart>& parts) {
        ExrLayer layer;
        layer.channels = names;
        for (const std::string& name : names)
            if (std::ranges::find(parts[0].channels, name) == parts[0].channels.end()) refuse(path, "has no channel \"" + name + "\"");
        return layer;
    });
}

ImageData readExr(const Path& path) { return readExrFile(path).image; }

}  // namespace lodestir
