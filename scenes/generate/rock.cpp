// SPDX-License-Identifier: MIT
// Placeholder.
#include "scenes.h"
namespace lodestir::generate {
void writeRock(const std::filesystem::path&) {}
}
