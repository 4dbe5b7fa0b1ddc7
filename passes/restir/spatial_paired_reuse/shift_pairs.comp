// SPDX-License-Identifier: MIT
// Shifts the paths of each pixel's partners to it, each once; what is shifted back is in the partner's record. With compaction the paths that have to be
// replayed are only listed, and a second run of this shader walks the list (Lin et al. 2026, section 6.2.2): lanes that wait for one that replays are few.
#version 460
#include "pass.glsl"
#include "stage.h"
#include "restir/shift.glsl"
#include "restir/pairing.glsl"
#include "restir/rounds.glsl"
#include "restir/similar_pixels.glsl"

const uint NOTHING = 0xffffffffu;

struct Path {
    Shift shift;
    PixelView view;
    ivec2 pixel;
    uint record;  // of the shift that is made, or NOTHING
};

bool walksList() { return argument(3) == STAGE_LISTED; }
bool lists() { return argument(3) == STAGE_LISTING; }

// x_2 as reconnection vertex needs but the camera ray and the connection.
bool needsReplay(Reservoir path) { return unpackShape(path.shape).k != 2; }

// The list is as long as it turns out to be: each lane walks every so-manieth of its shifts.
uint pathItems(World now) { return walksList() ? (listed(0) + push.extent.x - 1) / push.extent.x : pairing().slots; }
World pathWorld(World now, uint item) { return now; }

void pathStart(inout Path p, World w, ivec2 pixel) {
    p.pixel = pixel;
    if (!walksList()) p.view = pixelView(w, hits(place(pixel)));
}

bool pathBegin(inout Path p, World w, ivec2 pixel, uint item) {
    uint slot = item;
    if (walksList()) {
        uint i = item * push.extent.x + uint(pixel.x);
        p.record = NOTHING;
        if (i >= listed(0)) return false;
        p.record = replays(i);
        slot = p.record % pairing().slots;
        uint at = p.record / pairing().slots;
        p.pixel = ivec2(at % frameSize().x, at / frameSize().x);
    } else {
        p.record = place(pixel) * pairing().slots + slot;
    }
    PROBE_START(p.pixel);
    PROBE_OPEN(shifts);
    PROBE(partner, slot);
    ivec2 partner = partnerOf(pairing(), drawPairing(roundBits()), slot, p.pixel);
    if (!walksList() && (partner == pixel || !inside(partner) || !similarPixels(p.view, pixelView(w, hits(place(partner)))))) {
        PROBE_TEXT(none, "the partner lies off the image or is not like this pixel");
        p.shift.jacobian = SHIFT_NO_PARTNER;
        return false;
    }
    Reservoir path = inputReservoir(partner);
    PROBE_SHIFT(FORTH, partner, p.pixel);
    if (lists() && holdsPath(path) && needsReplay(path)) {
        storeReplays(addListed(0, 1), p.record);
        p.record = NOTHING;
        PROBE_TEXT(later, "it replays, and is made with the others that do");
        return false;
    }
    return shiftStart(p.shift, w, rules(), shiftTo(p.pixel, hits(place(p.pixel)), path, inputSample(partner)), frameSize());
}

Ray pathRay(inout Path p, out bool anyHit, out uint purpose) { return shiftRay(p.shift, anyHit, purpose); }
#define PATH_NUMBER
uint pathNumber(Path p, World w, ivec2 pixel) { return p.shift.number; }
#define PATH_TIME
float pathTime(Path p) { return p.shift.hit.time; }
bool pathStep(inout Path p, World w, Hit hit) { return shiftStep(p.shift, w, rules(), hit); }

void pathItemEnd(inout Path p, World w, ivec2 pixel, uint item) {
    if (p.record == NOTHING) return;
    PROBE_SHIFTED(p.shift.path.F, p.shift.jacobian);
    storeShifts(p.record, SharedShift(p.shift.path.F, p.shift.path.G, p.shift.jacobian));
    if (p.shift.jacobian <= 0.0 || rules().pixelCamera != 0u) return;
    PrimaryHit first = p.shift.hit.hit;
    storeFirstHits(p.record, SharedFirstHit(first.instance, first.primitive, first.barycentrics, p.shift.hit.uv));
}

void pathEnd(Path p, ivec2 pixel) {}

#include "trace/driver.glsl"
