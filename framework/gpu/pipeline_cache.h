// SPDX-License-Identifier: MIT
// The pipelines that a device has made lately: graphs that follow one another on it share most of theirs, and a driver takes seconds for one.
#pragma once
#include <framework/core/files.h>
#include <framework/gpu/pipeline.h>

#include <cstddef>
#include <list>
#include <memory>
#include <mutex>
#include <utility>

namespace lodestir::gpu {

/// The last ones asked for, by what they are made from (SPIR-V, constants, push block). Any thread may use it.
class PipelineCache {
public:
    /// nullptr: none of it is kept.
    std::shared_ptr<const Pipeline> find(const Hash& source);
    std::shared_ptr<const Pipeline> keep(const Hash& source, Pipeline pipeline);

private:
    static constexpr std::size_t capacity = 256;  // a few graphs with their variants; a day of editing shaders doesn't pile up
    std::mutex mutex_;
    std::list<std::pair<Hash, std::shared_ptr<const Pipeline>>> kept_;  ///< the one asked for last comes first
};

}  // namespace lodestir::gpu
