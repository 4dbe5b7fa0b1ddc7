// SPDX-License-Identifier: MIT
// Where a study's results lie, and what of them is to be made now.
#pragma once
#include <framework/core/files.h>
#include <framework/study/run_list.h>
#include <framework/study/workers.h>

#include <functional>
#include <string>

namespace lodestir {

struct StudyPlace {
    Path out;   ///< folder of the study
    Path file;  ///< that rows are added to
    Shard shard;
    Jobs jobs;
    std::function<bool()> stops;  ///< asked before each piece of work: is the rest left for another time?
    std::string problem{};        ///< what was wrong with a worker; empty: nothing
};

}  // namespace lodestir
