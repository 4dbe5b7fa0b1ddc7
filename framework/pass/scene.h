// SPDX-License-Identifier: MIT
// For passes that read the scene on the CPU: as it was loaded, which levels its own policy shows or others force, how it lies on the device, and what is
// called how.
#pragma once
#include <framework/core/error.h>
#include <framework/scene/forced_levels.h>
#include <framework/scene/level_policy.h>
#include <framework/scene/records.h>
#include <framework/scene/scene.h>

#include <string>
#include <vector>

namespace lodestir {

/// Place among `things` of the first one of that name. Error where there is none: "there is no <kind> <name> for <use>", with what is close to it.
template <class Thing>
std::uint32_t namedThing(const Scene& scene, const std::vector<Thing>& things, const std::string& name, const std::string& kind, const std::string& use) {
    std::vector<std::string> names;
    for (const Thing& thing : things) {
        if (thing.name == name) return std::uint32_t(names.size());
        names.push_back(thing.name);
    }
    throw Error(Where{scene.file.string()}, "there is no " + kind + " \"" + name + "\" for " + use, didYouMean(name, names));
}

}  // namespace lodestir
