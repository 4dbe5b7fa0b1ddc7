// SPDX-License-Identifier: MIT
// What was done to a graph by hand, step by step, so that it can be taken back and done again. No window, no GPU.
#pragma once
#include <framework/graph/description.h>
#include <framework/pass/parameter.h>

#include <chrono>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace lodestir {

/// How the graph differs from its file.
struct HandMade {
    std::optional<std::string> variant;
    std::vector<Json> patches;         ///< merged into the graph behind the variant, one after the other
    std::vector<Setting> settings;     ///< by the command line; a pass that is another now has no use for its own
    std::map<std::string, Value> set;  ///< parameters, "pass.parameter"
};

class EditHistory {
public:
    using Clock = std::chrono::steady_clock;

    /// Something was done. `before`: what there was. The same again within a second is part of one step: a slider that is dragged.
    LODESTIR_API void did(const std::string& what, HandMade before, Clock::time_point now = Clock::now());
    /// What can be taken back, and done again; empty: nothing.
    LODESTIR_API std::string undoable() const;
    LODESTIR_API std::string redoable() const;
    /// Where that leads. Only what has come about is noted, with what there was before it.
    const HandMade& beforeLast() const { return done_.back().other; }
    const HandMade& afterNext() const { return undone_.back().other; }
    LODESTIR_API void undid(HandMade before);
    LODESTIR_API void redid(HandMade before);

private:
    struct Step {
        std::string what;
        HandMade other;  ///< before it, once it is done; after it, once it is undone
    };
    std::vector<Step> done_, undone_;
    Clock::time_point last_{};
};

}  // namespace lodestir
