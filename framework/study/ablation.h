// SPDX-License-Identifier: MIT
// What each part of a technique is worth: further techniques that are the whole without it.
#pragma once
#include <framework/graph/renderer.h>
#include <framework/study/study_file.h>

namespace lodestir {

/// Behind each technique that asks for it, adds "X without Y" for each part Y that what is measured depends on: a boolean parameter that is on, or a pass
/// that hands something through when off; where asked, "X without Y and Z" for every two. Optional inputs that only a pass made which is off are left
/// unwired. A note tells which parts can't be taken away, and why: a graph that is none any more, or another pixel filter than before.
void expandAblations(Study& study, Renderer& renderer);

}  // namespace lodestir
