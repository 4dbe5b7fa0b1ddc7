// SPDX-License-Identifier: MIT
// Through which places of its pixel and of the lens a graph sees: what is judged needs the filter of its reference, else the difference of filters counts
// as error.
#pragma once
#include <framework/graph/graph.h>
#include <framework/study/study_file.h>

#include <set>
#include <string>

namespace lodestir {

/// Where camera rays cross their pixel and the lens: "random", "centre", or "frame", one place for a whole frame (on the film of all pixels, on the lens of
/// each, where paths begin at hits).
struct PixelFilter {
    std::string film, lens;
    auto operator<=>(const PixelFilter&) const = default;
};

/// Those of the rays that a port's light comes along, by the parameters `film`, `lens` and `camera` of the passes that make them. Several where passes
/// differ, none where no pass says so.
std::set<PixelFilter> filtersOf(const Graph& graph, const Source& measured);

/// Error where a technique sees through other places than its reference. Over the runs of an ensemble, each with a place of its own for all pixels of a
/// frame ("frame"), the mean is the box filter's, as that of random places is; one such frame is an image of its own.
void expectSameFilter(const Study& study, const Technique& technique, std::set<PixelFilter> filters,
                      std::set<PixelFilter> reference);

}  // namespace lodestir
