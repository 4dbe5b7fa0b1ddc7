// SPDX-License-Identifier: MIT
// A teapot: turned body and lid, swept spout and handle.
#pragma once

#include <string>

#include "glb.h"

namespace lodestir::generate {

/// A closed teapot that stands on y = 0, `height` metres tall with its lid; the spout points along +x.
Model teapot(const std::string& name, int material, float height);

}  // namespace lodestir::generate
