// SPDX-License-Identifier: MIT
// Levels that instances show whatever a policy says, as text: "rock=2, #3=0". Of what is said of an instance more than once the last counts.
#pragma once
#include <framework/scene/scene.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace lodestir {

struct ForcedLevel {
    std::string who;           ///< a name as a schedule has it; "#3": the fourth instance; "*": all
    std::optional<int> level;  ///< none, written "auto": the policy's again
    bool operator==(const ForcedLevel&) const = default;
};

/// Error where it isn't NAME=LEVEL, and so on after commas.
LODESTIR_API std::vector<ForcedLevel> readForced(const std::string& text);
LODESTIR_API std::string writeForced(const std::vector<ForcedLevel>& forced);
/// How to say that one instance is meant: its name, or its number where others have that name too or it can't be read back.
LODESTIR_API std::string whoIs(const Scene& scene, std::uint32_t instance);
/// The level of each instance, at most its mesh's coarsest; `none`: the policy's. Error where nobody is meant.
LODESTIR_API std::vector<std::uint32_t> forcedLevels(const Scene& scene, const std::string& text);

}  // namespace lodestir
