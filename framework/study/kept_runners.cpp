// SPDX-License-Identifier: MIT
#include <framework/gpu/memory_use.h>
#include <framework/study/kept_runners.h>

#include <algorithm>

namespace lodestir {
namespace {

constexpr double share = 1.0 / 16;  // of the device's memory, which several processes may use

}  // namespace

KeptRunner& KeptRunners::get(const gpu::Device& device, const std::string& key, const std::function<StagedGraph()>& build,
                             const std::function<std::unique_ptr<Runner>(StagedGraph&)>& bringUp) {
    if (const auto found = std::ranges::find(kept_, key, &KeptRunner::key); found != kept_.end()) {
        kept_.splice(kept_.begin(), kept_, found);
    } else {
        while (!kept_.empty() && gpu::memoryShare(device) > share) kept_.pop_back();
        kept_.push_front({.key = key, .staged = build(), .runner = nullptr});
        try {
            kept_.front().runner = bringUp(kept_.front().staged);
        } catch (...) {
            kept_.pop_front();
            throw;
        }
    }
    kept_.front().runner->reset();
    return kept_.front();
}

}  // namespace lodestir
