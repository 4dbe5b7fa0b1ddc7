// SPDX-License-Identifier: MIT
// Images of an ensemble to look at: the mean over all runs, and where it lies away from the reference.
#pragma once
#include <framework/core/files.h>
#include <framework/image/image.h>

#include <span>
#include <string>
#include <vector>

namespace lodestir {

/// Keeps a chunk's image (ChunkFrame::image, over `runs` runs) in a folder, and what joins the kept ones again.
void keepChunkImage(const Path& folder, const std::string& chunk, int offset, const ImageData& image, int runs);

/// Four channels, as ChunkFrame::image has them, over some runs.
struct EnsembleImage {
    ImageData image;
    double runs = 0;

    double luminance(std::size_t pixel) const;
    double variance(std::size_t pixel) const;  ///< of the mean of its luminance
};
/// Of each of the chunks. Error when one is not in the folder.
std::vector<EnsembleImage> readChunkImages(const Path& folder, const std::vector<std::string>& chunks, int offset);
/// Over the runs of all.
EnsembleImage joinImages(std::span<const EnsembleImage> images);

/// By how many standard deviations the luminance of each pixel's mean lies above the reference's; one channel. To look at, not to judge by:
/// pixels have heavy tails.
ImageData sigmaMap(const EnsembleImage& runs, const EnsembleImage& reference);

/// Linear RGB of values: white at 0, red at +top and more, blue at -top and less, green where the value is no number.
ImageData divergingMap(const ImageData& values, double top);

}  // namespace lodestir
