// SPDX-License-Identifier: MIT
// The texture maps of a material at a point of a triangle.
#include "base/pack.glsl"
#include "texture/texture.glsl"
#include "world/triangle.glsl"

/// Reads the slot's texture (not NONE). `uv` are the coordinates of set 0; set 1 is fetched only where a slot asks for it.
vec4 readMap(World w, TextureSlotRecord slot, vec2 uv, uvec3 corners, vec2 barycentrics) {
    if (slot.uvSet != 0u) uv = uvOn(w, corners, barycentrics, slot.uvSet);
    vec3 p = vec3(uv, 1.0);
    return sampleTexture(w, slot.texture, vec2(dot(slot.row0, p), dot(slot.row1, p)), 0.0);
}

/// Vertex colour, white where the material's meshes have none.
vec4 vertexColorOn(World w, uint material, uvec3 corners, vec2 barycentrics) {
    if ((w.materials.at[material].flags & MATERIAL_VERTEX_COLOR) == 0u) return vec4(1.0);
    vec4 color = vec4(0.0);
    vec3 weights = vec3(1.0 - barycentrics.x - barycentrics.y, barycentrics);
    for (int i = 0; i < 3; ++i) color += weights[i] * unpackColor(w.vertices.at[corners[i]].color);
    return color;
}
