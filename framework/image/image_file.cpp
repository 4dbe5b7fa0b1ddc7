// SPDX-License-Identifier: MIT
// Chooses the reader or writer of an image file.
#include <framework/core/error.h>
#include <framework/core/files.h>
#include <framework/image/exr.h>
#include <framework/image/hdr.h>
#include <framework/image/image_file.h>
#include <framework/image/jpeg.h>
#include <framework/image/png.h>

#include <fstream>

namespace lodestir {

namespace {

/// The first four bytes; fewer where there are no more.
std::string startOf(const Path& path) {
    std::string start(4, '\0');
    std::ifstream file(path, std::ios::binary);
    file.read(start.data(), static_cast<std::streamsize>(start.size()));
    start.resize(static_cast<std::size_t>(file.gcount()));
    return start;
}
bool isPng(const std::string& start) { return start == "\x89PNG"; }
bool isJpeg(const std::string& start) { return start.starts_with("\xff\xd8"); }

}  // namespace

bool isDisplayed(const Path& path) {
    const std::string start = startOf(path);
    return isPng(start) || isJpeg(start);
}

ImageData readImage(const Path& path) {
    const std::string start = startOf(path);
    if (start == "\x76\x2f\x31\x01") return readExr(path);
    if (isPng(start)) return readPng(path);
    if (isJpeg(start)) return readJpeg(path);
    if (start.starts_with("#?")) return readHdr(path);
    readBytes(path);  // a better reason, if the file is missing or stands for another
    throw Error(Where{path.string()}, "is not an image that this program reads",
                "known: OpenEXR (.exr), PNG (.png), JPEG (.jpg), Radiance (.hdr)");
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
