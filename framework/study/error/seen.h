// SPDX-License-Identifier: MIT
// What a study sees of a scene besides radiance: which object a pixel shows, how it moves, and whether it takes another level.
#pragma once
#include <framework/graph/renderer.h>
#include <framework/image/image.h>
#include <framework/shaders/world/primary_hit.h>
#include <framework/study/study_file.h>

#include <cstdint>
#include <vector>

namespace lodestir {

struct Seen {
    std::vector<std::vector<PrimaryHit>> hits;  ///< of each measured frame, at the centre of each pixel
    std::vector<ImageData> motions;             ///< likewise, from where a point is seen to where the frame before showed it, in pixels; two channels
    std::vector<std::uint32_t> changed;         ///< of each object, the number of the frame after the one in which its level last changed; 0: never
};

/// Does what a study measures depend on any of it?
bool needsSeen(const Study& study);
/// The graph that it is seen by: graphs/framework/seen.json, with levels by the scene's own policy.
Graph seenGraph(Renderer& renderer, const StudyScene& file);
/// Renders the frames of a study by that graph.
Seen seeFrames(Renderer& renderer, const Study& study, const StudyScene& file, const Scene& scene);

/// Of each measured frame, the pixels whose centres see an object that takes another level at the event or later, up to the last measured frame: the
/// mask "switched". Error when there is none, unless it is `optional` and no object does: then there are no masks.
std::vector<std::vector<bool>> switchedMasks(const Seen& seen, const Study& study, const StudyScene& file, bool optional);

}  // namespace lodestir
