// SPDX-License-Identifier: MIT
// What a run of shift_pairs.comp does: its argument 3.
#ifndef LODESTIR_PAIRED_STAGE_H
#define LODESTIR_PAIRED_STAGE_H
#include "base/shared.h"

LODESTIR_SHARED_BEGIN

const uint STAGE_ALL = 0u;      // every shift
const uint STAGE_LISTING = 1u;  // those without replay; the others are listed
const uint STAGE_LISTED = 2u;   // those of the list

LODESTIR_SHARED_END
#endif
