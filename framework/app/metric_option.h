// SPDX-License-Identifier: MIT
// The option --metrics, as every command that compares images has it.
#pragma once
#include <framework/app/command_line.h>

#include <string>
#include <vector>

namespace lodestir {

/// Names out of `known`, separated by commas; another name is wrong use, with a guess at what was meant.
CommandOption addMetrics(Command& command, std::vector<std::string>& metrics, std::vector<std::string> known, const std::string& about);

}  // namespace lodestir
