// SPDX-License-Identifier: MIT
// Which of an OpenEXR file's channels are its image.
#pragma once
#include <framework/core/api.h>

#include <cstddef>
#include <string>
#include <vector>

namespace lodestir {

/// The names in one part of a file.
struct ExrPart {
    std::string name;                   ///< empty in files of one part
    std::vector<std::string> channels;  ///< as the file orders them; none: this part can't be read
};

/// What the channels of a layer are, the best first.
enum class ExrContent { color, luminanceChroma, grey, someColors, vector, unknown };

/// Channels that are one image.
struct ExrLayer {
    std::size_t part = 0;
    std::string name;    ///< of part and layer; empty: the layer of channels without a dot in a file of one part
    std::string prefix;  ///< what its channels' names begin with, without the dot
    ExrContent content = ExrContent::unknown;
    std::vector<std::string> channels;  ///< whole names, in the order of the image
    bool hasOpacity = false;            ///< the last of them is
    std::vector<std::string> others;    ///< names of layers of the same content that were not taken
};

/// A layer is what channels of a part have before their last dot; a channel's part in it is the rest of its name, in any case: R, G, B
/// (red, green, blue), A (alpha), Y alone as grey, Y with RY and BY, X Y Z. The layer with the best content is taken; among those the
/// unnamed one, else one called combined, beauty, rgba, rgb or color, else the first.
/// Where no layer has a content, all channels of the first part that has any, as they come, A last.
LODESTIR_API ExrLayer chooseLayer(const std::vector<ExrPart>& parts);

}  // namespace lodestir
