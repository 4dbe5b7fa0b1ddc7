// SPDX-License-Identifier: MIT
#include <framework/gpu/pipeline_cache.h>

#include <algorithm>

namespace lodestir::gpu {

std::shared_ptr<const Pipeline> PipelineCache::find(const Hash& source) {
    const std::lock_guard lock(mutex_);
    const auto found = std::ranges::find(kept_, source, [](const auto& kept) { return kept.first; });
    if (found == kept_.end()) return nullptr;
    kept_.splice(kept_.begin(), kept_, found);
    return found->second;
}

std::shared_ptr<const Pipeline> PipelineCache::keep(const Hash& source, Pipeline pipeline) {
    const std::lock_guard lock(mutex_);
    if (kept_.size() == capacity) kept_.pop_back();
    return kept_.emplace_front(source, std::make_shared<const Pipeline>(std::move(pipeline))).second;
}

}  // namespace lodestir::gpu
