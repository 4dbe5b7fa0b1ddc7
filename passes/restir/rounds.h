// SPDX-License-Identifier: MIT
// Where rounds of spatial reuse read and write (restir/rounds.glsl).
#ifndef LODESTIR_ROUNDS_H
#define LODESTIR_ROUNDS_H
#include "base/shared.h"

LODESTIR_SHARED_BEGIN

const uint ROUND_INPUT = 0u;    // what the pass is given
const uint ROUND_OUTPUT = 1u;   // what it makes
const uint ROUND_BETWEEN = 2u;  // what one round hands to the next

LODESTIR_SHARED_END

#ifdef __cplusplus
namespace lodestir {

/// Calls round(number, from, to), the first three arguments of its shaders, so that the last round writes the output.
template <class F> void forRounds(std::uint32_t count, F&& round) {
    for (std::uint32_t i = 0, from = ROUND_INPUT; i < count; ++i) {
        const std::uint32_t to = (count - i) % 2 == 1 ? ROUND_OUTPUT : ROUND_BETWEEN;
        round(i, from, to);
        from = to;
    }
}

}  // namespace lodestir
#endif
#endif
