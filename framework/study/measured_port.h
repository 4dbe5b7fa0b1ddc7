// SPDX-License-Identifier: MIT
// What is measured of a graph.
#pragma once
#include <framework/graph/graph.h>
#include <framework/study/study_file.h>

namespace lodestir {

/// The port that a study names; else the shown one, or what stands before passes that make images for eyes: errors are measured in radiance. Error where
/// there is none of that name.
Source measuredPort(const Graph& graph, const StudyGraph& choice);

/// The port of a counter. Error where there is none of that name, or it holds no number.
Source counterPort(const Graph& graph, const Counter& counter);

}  // namespace lodestir
