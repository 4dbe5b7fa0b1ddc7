// SPDX-License-Identifier: MIT
// The commands of `lodestir` and what they have in common: help, exit status, how errors are told.
#pragma once
#include <framework/core/api.h>

namespace lodestir {

/// Exit status: 0 good, 1 failed (one line a problem on stderr), 2 wrong use of the command line.
LODESTIR_API int runProgram(int argc, char** argv);

}  // namespace lodestir
