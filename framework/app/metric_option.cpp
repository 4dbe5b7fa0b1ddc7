// SPDX-License-Identifier: MIT
#include <framework/app/metric_option.h>
#include <framework/core/error.h>

#include <CLI/CLI.hpp>

#include <algorithm>

namespace lodestir {

CLI::Option* addMetrics(CLI::App& command, std::vector<std::string>& metrics, std::vector<std::string> known, const std::string& about) {
    return command.add_option("--metrics", metrics, about)
        ->delimiter(',')
        ->allow_extra_args(false)  // what follows may be a file
        ->check([known = std::move(known)](const std::string& name) {
            const bool isKnown = std::ranges::find(known, name) != known.end();
            return isKnown ? std::string() : "unknown metric \"" + name + "\"; " + didYouMean(name, known);
        });
}

}  // namespace lodestir
