// SPDX-License-Identifier: MIT
// Ctrl-C and SIGTERM, taken as the wish to end after what is under way.
#pragma once

namespace lodestir {

/// While one lives, the first such signal is kept to be asked for; a second one kills as ever.
class InterruptWatch {
public:
    InterruptWatch();
    ~InterruptWatch();
    InterruptWatch(const InterruptWatch&) = delete;
    InterruptWatch& operator=(const InterruptWatch&) = delete;

    /// Number of the signal that came; 0: none.
    int signal() const;
    const char* name() const;  ///< "SIGINT" or "SIGTERM", where one came
};

}  // namespace lodestir
