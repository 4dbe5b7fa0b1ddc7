// SPDX-License-Identifier: MIT
// main() of a pass that reuses paths: a pixel's shifts, one after the other. Each partner of a pixel (a neighbour, the pixel's past, ...) costs two: the
// path that is to be reused goes FORTH, and the path that it is weighed against goes BACK, so that either is known where the other was made.
//
// The includer defines, before it includes this file,
//   struct Reuse { ... };                                    all that a pixel keeps from shift to shift
//   uint reusePartners();                                    of a pixel
//   World reuseWorld(World now, uint partner, uint way);     that the shift leads to
//   void reuseStart(inout Reuse r, World now, ivec2 pixel);  before the first shift
//   ShiftTask reuseTask(inout Reuse r, World w, ivec2 pixel, uint partner, uint way);    where a path comes from and goes to; shiftOfNothing(): nowhere
//   void reuseResult(inout Reuse r, ivec2 pixel, uint partner, uint way, Shift result);  what has become of it; jacobian 0: there is no such path
//   void reuseEnd(Reuse r, ivec2 pixel);                     after the last shift
// where `now` is the pass's input `world`. FORTH, BACK and what shifts are made of are in restir/shift.glsl. The pass has an input `rules`, those that the
// paths were made by.

struct Path {
    Shift shift;
    Reuse reuse;
};

bool isShift(uint item) { return item < WAYS * reusePartners(); }
uint pathItems(World now) { return max(WAYS * reusePartners(), 1u); }
World pathWorld(World now, uint item) { return reuseWorld(now, item / WAYS, item % WAYS); }

void pathStart(inout Path p, World now, ivec2 pixel) { reuseStart(p.reuse, now, pixel); }

bool pathBegin(inout Path p, World w, ivec2 pixel, uint item) {
    ShiftTask task = shiftOfNothing();
    if (isShift(item)) {
        PROBE_OPEN(shifts);
        PROBE(partner, item / WAYS);
        task = reuseTask(p.reuse, w, pixel, item / WAYS, item % WAYS);
    }
    return shiftStart(p.shift, w, rules(), task, frameSize());
}

Ray pathRay(inout Path p, out bool anyHit, out uint purpose) { return shiftRay(p.shift, anyHit, purpose); }
#define PATH_NUMBER
uint pathNumber(Path p, World w, ivec2 pixel) { return p.shift.number; }
#define PATH_TIME
float pathTime(Path p) { return p.shift.hit.time; }
bool pathStep(inout Path p, World w, Hit hit) { return shiftStep(p.shift, w, rules(), hit); }

void pathItemEnd(inout Path p, World w, ivec2 pixel, uint item) {
    if (!isShift(item)) return;
    PROBE_SHIFTED(p.shift.path.F, p.shift.jacobian);
    reuseResult(p.reuse, pixel, item / WAYS, item % WAYS, p.shift);
}

void pathEnd(Path p, ivec2 pixel) { reuseEnd(p.reuse, pixel); }

#include "trace/driver.glsl"
