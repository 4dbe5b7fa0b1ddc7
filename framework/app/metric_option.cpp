// SPDX-License-Identifier: MIT
#include <framework/app/metric_option.h>
#include <framework/core/error.h>

#include <algorithm>

namespace lodestir {

CommandOption addMetrics(Command& command, std::vector<std::string>& metrics, std::vector<std::string> known, const std::string& about) {
    return command.option("--metrics", metrics, about).list().trimmed().check([known = std::move(known)](const std::string& name) {
        const bool isKnown = std::ranges::find(known, name) != known.end();
        return isKnown ? std::string() : "unknown metric \"" + name + "\"; " + didYouMean(name, known);
    });
}

}  // namespace lodestir
