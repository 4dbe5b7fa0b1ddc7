// SPDX-License-Identifier: MIT
// Copies of a path along an exposure, which is divided into parts of one length: copy i of a path at time s, the share of its exposure that has passed, is
// at (s + i) / parts, ds' = ds / parts (Liu et al. 2025, Reservoir Splatting: several splats of a path where there is motion blur). Together the copies are
// one technique, as the splats of all pixels are: a time lies in one part, and so is the copy of one time.

const float TIME_STEP = 1.0 / 16777216.0;  // times are drawn on this grid

/// Time of the copy in `part`. Sum and quotient are rounded, but never into the next part.
float timeInPart(float time, uint part, uint parts) {
    return min((time + float(part)) / float(parts), float(part + 1u) / float(parts) - TIME_STEP);
}

uint partOf(float time, uint parts) { return min(uint(time * float(parts)), parts - 1u); }

/// The time whose copy is at `time`.
float timeOfOriginal(float time, uint parts) { return clamp(time * float(parts) - float(partOf(time, parts)), 0.0, 1.0 - TIME_STEP); }
