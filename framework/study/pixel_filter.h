// SPDX-License-Identifier: MIT
// Through which places of its pixel a graph sees: what is judged needs the pixel filter of its reference, else the difference of filters counts as error.
#pragma once
#include <framework/graph/graph.h>
#include <framework/study/study_file.h>

#include <set>
#include <string>

namespace lodestir {

/// Places that the camera rays of a port's light cross their pixel at: values of the parameter `film` of the passes that make these rays ("random",
/// "centre", "frame"). Several where passes differ, none where no pass says so.
std::set<std::string> filmsOf(const Graph& graph, const Source& measured);

/// Error where a technique sees through other places than its reference. Over the runs of an ensemble, each with a place of its own for all pixels of a
/// frame ("frame"), the mean is the box filter's, as that of random places is; one such frame is an image of its own.
void expectSameFilter(const Study& study, const Technique& technique, const std::set<std::string>& films, const std::set<std::string>& reference);

}  // namespace lodestir
