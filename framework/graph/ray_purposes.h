// SPDX-License-Identifier: MIT
// What rays are for, by name, as the ledger counts them.
#pragma once
#include <framework/shaders/base/frame.h>

#include <array>
#include <string_view>

namespace lodestir {

/// Names of the ray purposes, in the ledger's order.
inline constexpr std::array<std::string_view, RAYS_PURPOSES> rayPurposes{"primary", "nee", "continue", "replay", "connect", "visibility", "steps"};

}  // namespace lodestir
