// SPDX-License-Identifier: MIT
// Small plots of two sides, A and B, each in its colour.
#pragma once
#include <framework/app/view/view_state.h>

#include <imgui/imgui.h>

namespace lodestir {

ImVec4 colorOfA();
ImVec4 colorOfB();

/// Errors over frames, both by their logarithms: noise that is averaged away is a straight line.
void plotErrors(const std::vector<ErrorPoint>& a, const std::vector<ErrorPoint>& b, double ErrorPoint::*metric, float height);
void plotHistograms(const Histograms& histograms, float height);

}  // namespace lodestir
