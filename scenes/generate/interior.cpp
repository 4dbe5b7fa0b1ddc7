// SPDX-License-Identifier: MIT
// Placeholder.
#include "scenes.h"
namespace lodestir::generate {
void writeInterior(const std::filesystem::path&) {}
}
