// SPDX-License-Identifier: MIT
// What the errors of one scene are measured against.
#pragma once
#include <framework/image/flip.h>
#include <framework/study/error/halves.h>
#include <framework/study/stage.h>

#include <map>
#include <string>
#include <vector>

namespace lodestir {

/// The references of one scene, and the exposures at which all its errors are measured.
struct SceneReferences {
    std::size_t scene = 0;
    double exposure = 1;
    FlipExposures flipExposures;
    std::vector<Halves> frames, finest;    ///< parallel to Study::measure; the second where the study asks for it
    std::map<std::string, std::vector<std::vector<bool>>> masks;  ///< by name; likewise
    std::vector<ImageData> motions;        ///< likewise
};

/// The halves of all references of a scene that `folder` doesn't hold, each once.
std::vector<ReferenceHalf> missingHalves(Stage& stage, const Study& study, std::size_t scene, const Path& folder);

/// Reads them from a folder, makes what is missing there, and looks at what else is seen of the scene. Error where a reference isn't finite.
SceneReferences loadReferences(Stage& stage, const Study& study, std::size_t scene, const Path& folder);

}  // namespace lodestir
