// SPDX-License-Identifier: MIT
// Things of a study that its file calls by their names.
#pragma once
#include <framework/core/error.h>

#include <algorithm>
#include <iterator>
#include <string>
#include <vector>

namespace lodestir {

/// The index of the one of `all` whose `Name` member is `name`; `what` it should be: "technique". Error at `where` when the study has none.
template <auto Name, class T>
std::size_t indexNamed(const std::vector<T>& all, const std::string& name, const std::string& what, const Where& where) {
    std::vector<std::string> names;
    std::ranges::transform(all, std::back_inserter(names), Name);
    const auto found = std::ranges::find(names, name);
    if (found == names.end()) throw Error(where, "the study has no " + what + " \"" + name + "\"", didYouMean(name, names));
    return std::size_t(found - names.begin());
}

}  // namespace lodestir
