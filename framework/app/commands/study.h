// SPDX-License-Identifier: MIT
// lodestir study STUDY: runs a study and reports on it.
#pragma once
#include <functional>

namespace CLI {
class App;
}

namespace lodestir {

void addStudy(CLI::App& app, std::function<int()>& run);

}  // namespace lodestir
