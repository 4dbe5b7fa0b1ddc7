// SPDX-License-Identifier: MIT
// Work spread over the machine's cores.
#pragma once
#include <framework/core/api.h>

#include <cstddef>
#include <functional>

namespace lodestir {

/// Number of worker threads that parallelFor uses: the hardware's, at least 1.
LODESTIR_API std::size_t workerCount();

/// Calls body(begin, end) over [0, count) in chunks of at least `grain`, on all cores; returns when all are done.
/// The first exception thrown by a body is rethrown. Results must not depend on the split (same bits for any core count).
LODESTIR_API void parallelFor(std::size_t count, std::size_t grain, const std::function<void(std::size_t begin, std::size_t end)>& body);

/// Runs both, possibly at the same time (nested use is fine: it falls back to running in sequence when all cores are busy).
LODESTIR_API void parallelInvoke(const std::function<void()>& first, const std::function<void()>& second);

}  // namespace lodestir
