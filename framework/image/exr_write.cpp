// SPDX-License-Identifier: MIT
// Writes OpenEXR files.
#include <framework/core/error.h>
#include <framework/core/files.h>
#include <framework/image/exr.h>
#include <framework/image/exr_stream.h>

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfOutputFile.h>
#include <ImfStringAttribute.h>
#include <half.h>

#include <algorithm>
#include <cmath>

namespace lodestir {
namespace {

std::vector<std::string> defaultNames(const ImageData& image) {
    switch (image.channels) {
    case 1: return {"Y"};
    case 2: return {image.hasOpacity ? "Y" : "R", image.hasOpacity ? "A" : "G"};
    case 3: return {"R", "G", "B"};
    case 4: return {"R", "G", "B", "A"};
    default: throw Error("an image of " + std::to_string(image.channels) + " channels needs a name for each to be written as OpenEXR");
    }
}

/// Rounds to nearest even. A finite value stays finite: one infinity would make every mean of the image infinite.
half toHalf(float value) {
    constexpr float largest = 65504;
    return half(std::isfinite(value) ? std::clamp(value, -largest, largest) : value);
}

std::string encode(const std::string& name, const ImageData& image, const std::vector<std::string>& names, const ExrOptions& options) {
    Imf::Header header(image.width, image.height);
    header.compression() = Imf::ZIP_COMPRESSION;
    for (const auto& [key, text] : options.attributes) header.insert(key, Imf::StringAttribute(text));

    const bool isHalf = options.type == ExrOptions::Type::half;
    std::vector<half> halves(isHalf ? image.values.size() : 0);
    if (isHalf) std::ranges::transform(image.values, halves.begin(), toHalf);

    // OpenEXR only reads from the frame buffer, though it takes a pointer to mutable memory.
    char* const first = isHalf ? reinterpret_cast<char*>(halves.data()) : reinterpret_cast<char*>(const_cast<float*>(image.values.data()));
    const Imf::PixelType type = isHalf ? Imf::HALF : Imf::FLOAT;
    const std::size_t size = isHalf ? sizeof(half) : sizeof(float), pixelStride = size * names.size();
    Imf::FrameBuffer source;
    for (std::size_t i = 0; i < names.size(); ++i) {
        header.channels().insert(names[i], Imf::Channel(type));
        source.insert(names[i], Imf::Slice(type, first + i * size, pixelStride, pixelStride * static_cast<std::size_t>(image.width)));
    }
    ExrOutput stream(name);
    {
        Imf::OutputFile file(stream, header, /* numThreads = */ 0);
        file.setFrameBuffer(source);
        file.writePixels(image.height);
    }  // the destructor writes the table of lines
    return stream.bytes();
}

}  // namespace

void writeExr(const Path& path, const ImageData& image, const ExrOptions& options) {
    const std::vector<std::string> names = options.channels.empty() ? defaultNames(image) : options.channels;
    if (names.size() != static_cast<std::size_t>(image.channels)) {
        throw Error(Where{path.string()},
                    "cannot be written: " + std::to_string(image.channels) + " channels have " + std::to_string(names.size()) + " names");
    }
    try {
        writeFile(path, encode(path.filename().string(), image, names, options));
    } catch (const Error&) {
        throw;
    } catch (const std::exception& error) {
        throw Error(Where{path.string()}, std::string("cannot be written: ") + error.what());
    }
}

}  // namespace lodestir
