// SPDX-License-Identifier: MIT
// Chooses the reader or writer of an image file.
#include <framework/core/error.h>
#include <framework/core/files.h>
#include <framework/image/exr.h>
#include <framework/image/hdr.h>
#include <framework/image/image_file.h>
#include <framework/image/png.h>

#include <fstream>

namespace lodestir {

ImageData readImage(const Path& path) {
    std::string start(4, '\0');
    std::ifstream(path, std::ios::binary).read(start.data(), static_cast<std::streamsize>(start.size()));
    if (start == "\x76\x2f\x31\x01") return readExr(path);
    if (start == "\x89PNG") return readPng(path);
    if (start.starts_with("#?")) return readHdr(path);
    readBytes(path);  // a better reason, if the file is missing or stands for another
    throw Error(Where{path.string()}, "is not an image that this program reads", "known: OpenEXR (.exr), PNG (.png), Radiance (.hdr)");
}

void writeImage(const Path& path, const ImageData& image, const std::map<std::string, std::string>& attributes) {
    if (path.extension() == ".exr") {
        writeExr(path, image, {.attributes = attributes});
    } else if (path.extension() == ".png") {
        writePng(path, image);
    } else {
        throw Error(Where{path.string()}, "cannot be written: its name says no kind of image", "end it in .exr or .png");
    }
}

}  // namespace lodestir
