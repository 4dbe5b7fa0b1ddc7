// SPDX-License-Identifier: MIT
// A function run in a process of its own, so that a crash or a hang in it ends that process alone.
#pragma once
#include <framework/core/api.h>

#include <chrono>
#include <functional>
#include <string>

namespace lodestir {

struct ChildEnd {
    enum class Way { returned, threw, died, overdue };
    Way way = Way::died;
    std::string text;  ///< returned: what the function did; threw: the exception's text
    int signal = 0;    ///< died: by this signal; 0: it left by itself
};

/// Runs `work` in a child and waits for it, no longer than `limit`. To be called while this process has one thread and has opened nothing
/// that cannot be shared, such as a Vulkan driver. Error when there can be no child.
LODESTIR_API ChildEnd runInChild(const std::function<std::string()>& work, std::chrono::duration<double> limit);

}  // namespace lodestir
