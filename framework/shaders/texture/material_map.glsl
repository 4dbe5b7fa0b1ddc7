// SPDX-License-Identifier: MIT
// The texture maps of a material at a point of a triangle.
#include "base/pack.glsl"
#include "texture/texture.glsl"
#include "world/triangle.glsl"

/// Reads the slot's texture (not NONE) at coordinates of its set. `lod` as in sampleTexture.
vec4 readMap(World w, TextureSlotRecord slot, vec2 uv, float lod) {
    vec3 p = vec3(uv, 1.0);
    return sampleTexture(w, slot.texture, vec2(dot(slot.row0, p), dot(slot.row1, p)), lod);
}

/// At its finest level. `uv` are the coordinates of set 0; set 1 is fetched only where a slot asks for it.
vec4 readMap(World w, TextureSlotRecord slot, vec2 uv, uvec3 corners, vec2 barycentrics) {
    if (slot.uvSet != 0u) uv = uvOn(w, corners, barycentrics, slot.uvSet);
    return readMap(w, slot, uv, 0.0);
}

const float DENSITY_NONE = -1e30;  // no texture coordinates, or all the same

/// Level of the slot's texture that what is seen is read at: texels half as wide, because reading spreads over two a side.
/// density: log2 of texture coordinates per side of that.
float mapLevel(World w, TextureSlotRecord slot, float density) {
    float texels = float(w.textures.at[slot.texture].width) * float(w.textures.at[slot.texture].height);
    float turned = abs(slot.row0.x * slot.row1.y - slot.row0.y * slot.row1.x);
    return max(0.0, density - 1.0 + 0.5 * log2(max(texels * turned, 1e-30)));
}

/// Vertex colour, white where the material's meshes have none.
vec4 vertexColorOn(World w, uint material, uvec3 corners, vec2 barycentrics) {
    if ((w.materials.at[material].flags & MATERIAL_VERTEX_COLOR) == 0u) return vec4(1.0);
    vec4 color = vec4(0.0);
    vec3 weights = vec3(1.0 - barycentrics.x - barycentrics.y, barycentrics);
    for (int i = 0; i < 3; ++i) color += weights[i] * unpackColor(w.vertices.at[corners[i]].color);
    return color;
}
