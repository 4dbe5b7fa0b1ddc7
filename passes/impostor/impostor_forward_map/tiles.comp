// SPDX-License-Identifier: MIT
// The tiles that may be seen, in any order: not the empty ones, nor those whose normals all face away, nor those beside the film.
#version 460
#include "pass.glsl"
#include "splat.glsl"

/// A vector taken from world to object space, up to the transform's scale.
vec3 intoObject(Placement p, vec3 v) {
    vec3 back = v.x * cross(p.row1, p.row2) + v.y * cross(p.row2, p.row0) + v.z * cross(p.row0, p.row1);
    return back / placementDeterminant(p);
}

/// Does a cone of normals hold one that faces the camera from some point of a sphere around the tile? All in object space, where cones are cones whatever
/// the instance's scale.
bool mayFace(World w, TileRecord tile, Placement placement, vec3 axis, vec3 center, float radius) {
    if (!params.backFaces || tile.cosine <= -1.0) return true;
    bool parallel = w.camera.orthographic != 0u;
    vec3 way = parallel ? intoObject(placement, -w.camera.forward) : intoObject(placement, w.camera.position - placement.translation) - center;
    float distance = length(way), apart = parallel ? 0.0 : asin(min(1.0, radius / distance));
    float nearest = acos(clamp(dot(axis, way) / distance, -1.0, 1.0)) - acos(clamp(tile.cosine, -1.0, 1.0)) - apart;
    return cos(max(nearest, 0.0)) > -BACK_SLACK;
}

/// Does a sphere reach the film?
bool mayLand(World w, vec3 center, float radius) {
    vec3 seen = cameraProject(w, center, LENS_CENTRE);
    if (seen.z < -radius) return false;
    if (seen.z < 2.0 * radius) return true;
    vec2 reach = vec2(radius) / vec2(length(w.camera.right), length(w.camera.up)) * 0.5;
    if (w.camera.orthographic == 0u) reach *= 1.5 / (seen.z - radius);  // towards the film's corners spheres are drawn out
    reach += 4.0 / vec2(frameSize());
    return all(greaterThan(seen.xy, -reach)) && all(lessThan(seen.xy, 1.0 + reach));
}

bool mayShow(World w, Impostors made, DrawnTexel x) {
    uint mesh = w.instances.at[x.instance].mesh;
    ImpostorRecord object = made.objects.at[mesh];
    TileRecord tile = TileArray(object.tiles).at[tileIndex(made, x.place.level, x.place.view, x.place.texel / TILE)];
    if (tile.nearest > tile.farthest) return false;
    ImpostorView v = impostorView(made.views, x.place.view);
    Placement placement = placementOf(w, x.instance);
    float n = float(levelResolution(made, x.place.level)), side = min(float(TILE), n) / n;
    vec3 middle = windowPoint(made, object.center, object.radius, v, vec2(x.place.texel) / n + 0.5 * side, 0.5 * (tile.nearest + tile.farthest));
    vec3 extent = object.radius * vec3(side * windowMargin(made), side * windowMargin(made), tile.farthest - tile.nearest);
    vec3 reach = abs(extent.x * placeVector(placement, v.x)) + abs(extent.y * placeVector(placement, v.y)) + abs(extent.z * placeVector(placement, v.d));
    vec3 center = placePoint(placement, middle);
    return mayFace(w, tile, placement, outOfView(v, unpackNormal(tile.axis)), middle, length(extent)) && mayLand(w, center, length(reach));
}

void main() {
    if (skip()) return;
    World w = world();
    Impostors made = impostors();
    for (uint tile = uint(pixel().x); tile < total(0u); tile += push.extent.x)
        if (mayShow(w, made, tileOfNumber(made, tile))) storeShown(addTilesShown(0u, 1u), tile);
}
