// SPDX-License-Identifier: MIT
// From the key of each pixel to what its texel shows.
#version 460
#include "pass.glsl"
#include "impostor/reduce.glsl"
#include "impostor/texel_between.glsl"
#include "splat.glsl"

const Surfel NOTHING = Surfel(NONE, 0.0, 0u, 0u, 0u, NONE, 0.0, NONE);

/// One material, where counts are of one alone.
void nameMaterials(inout Surfel f, ImpostorRecord object, ImpostorTexel t) {
    uint place = commonestPlace(t.counts);
    if (countOf(t.counts, place) == 15u) {
        f.materials = object.palette[place];
    } else {
        f.materials = t.counts;
        f.measures |= SURFEL_COUNTS << 24;
    }
}

bool fadesWithGeometry(uint instance) {
    Drawn d = drawn(instance);
    return d.share < 1.0 && (d.now.level == NOT_DRAWN || d.before.level == NOT_DRAWN);
}

void main() {
    if (skip()) return;
    ivec2 p = pixel();
    SplatKey key = keys(pixelIndex(p));
    Surfel f = NOTHING;
    if (key.low != NONE) {
        World w = world();
        Impostors made = impostors();
        DrawnTexel x;
        texelOfNumber(made, key.low, x);
        uint mesh = w.instances.at[x.instance].mesh;
        ImpostorTexel t = texelAt(made, mesh, x.place.level, x.place.view, x.place.texel);
        Splat s;
        splatOf(w, made, x, t, s);
        t = texelBetween(made, mesh, x.place, t, inSplat(s, p));
        f.instance = x.instance;
        f.depth = depthIn(s, p);
        vec3 normal = normalOutOfView(placementOf(w, x.instance), impostorView(made.views, x.place.view), t.normal, -w.camera.forward);
        f.normal = packNormal(s.turned ? -normal : normal);
        if (s.turned) t.flags ^= TEXEL_BACK;
        if (fadesWithGeometry(x.instance)) t.flags |= SURFEL_FADES;
        f.measures = packShape(t).z;
        f.uv = packUv(t.uv);
        f.materials = t.material;
        f.alpha = params.blend ? t.alpha : 1.0;
        f.texel = texelIndex(made, x.place.level, x.place.view, x.place.texel);
        if (x.place.level > 0u) nameMaterials(f, made.objects.at[mesh], t);
    }
    storeSurfels(pixelIndex(p), f);
}
