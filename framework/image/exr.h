// SPDX-License-Identifier: MIT
// OpenEXR files: the form in which results are kept.
#pragma once
#include <framework/image/image.h>

#include <map>
#include <string>
#include <vector>

namespace lodestir {

/// What an OpenEXR file holds besides its pixels.
struct ExrFile {
    ImageData image;
    std::vector<std::string> channels;              ///< name of each channel of the image
    std::map<std::string, std::string> attributes;  ///< the header's text attributes
};

/// Reads one layer of a file of scan lines or tiles (their finest level), of half, float or integer channels: the one that chooseLayer
/// (exr_layers.h) takes, with a note where there were others like it. Luminance and chroma become R, G, B. A file without any colour gives all
/// channels, and a warning where there are several. The image is the display window: what the data window leaves out is 0, what lies
/// beyond is dropped.
/// Throws Error naming the file when it cannot be read, is damaged or cut, is deep or no OpenEXR file, or claims an absurd size.
LODESTIR_API ExrFile readExrFile(const std::filesystem::path& path);
LODESTIR_API ImageData readExr(const std::filesystem::path& path);

/// Reads these channels of the first part, whatever they mean. Error as above, and when one of them isn't there.
LODESTIR_API ExrFile readExrChannels(const std::filesystem::path& path, const std::vector<std::string>& names);

/// How an image is to be written.
struct ExrOptions {
    enum class Type { half, single } type = Type::single;  ///< 16 or 32 bits; halves are finite: larger values become +-65504
    std::vector<std::string> channels{};                   ///< one name each; empty: Y, YA (with opacity), RG, RGB or RGBA
    std::map<std::string, std::string> attributes{};       ///< text for the header, such as the resolved graph as "lodestir"
};

/// Writes scan lines with ZIP compression. The same arguments give the same bytes. Throws Error when the file cannot be written.
LODESTIR_API void writeExr(const std::filesystem::path& path, const ImageData& image, const ExrOptions& options = {});

}  // namespace lodestir
