// SPDX-License-Identifier: MIT
// Texture painting: a surface described point by point becomes colour, normal and roughness pictures.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include <glm/glm.hpp>

namespace lodestir::generate {

/// Eight bits per channel, top row first.
struct Picture {
    int width = 0, height = 0, channels = 0;
    std::vector<uint8_t> bytes;

    Picture() = default;
    Picture(int w, int h, int c) : width(w), height(h), channels(c), bytes(size_t(w) * size_t(h) * size_t(c)) {}
    uint8_t* at(int x, int y) { return bytes.data() + (size_t(y) * size_t(width) + size_t(x)) * size_t(channels); }
    bool empty() const { return bytes.empty(); }
};

/// What a surface is at one point.
struct Surface {
    glm::vec3 color{0.5f};  ///< linear reflectance, Rec.709
    float alpha = 1;
    float roughness = 0.8f;  ///< perceptual, as in glTF
    float metalness = 0;
    float height = 0;  ///< metres above the mesh; shapes the normals
};

/// The pictures of one material. `normal` and `roughness` are empty when they would be flat.
struct Textures {
    Picture color;      ///< sRGB; four channels when anything is cut out
    Picture normal;     ///< tangent space, +Y up the picture
    Picture roughness;  ///< G: roughness, B: metalness (glTF 2.0, section 3.9.2)
};

/// How a painted picture lies on the mesh.
struct Canvas {
    int width = 512, height = 512;
    glm::vec2 metres{1};  ///< size of the picture on the surface
    bool repeats = true;  ///< derivatives wrap around the border
    bool smooth = false;  ///< no normal picture even if heights vary
};

/// Evaluates `surface` at every texel centre; its argument is the point in metres, x to the right and y down.
Textures paint(const Canvas& canvas, const std::function<Surface(const glm::vec2& metres)>& surface);

/// The same over all directions, laid out as sphere() lays its UVs; heights in radii.
Textures paintSphere(int width, int height, const std::function<Surface(const glm::vec3& direction)>& surface);

/// sRGB encoding (IEC 61966-2-1) of a linear value, rounded to eight bits.
uint8_t encodeSrgb(float linear);

/// A value in [0, 1] as eight bits.
uint8_t encodeUnit(float value);

/// A unit vector as an RGB texel.
void writeNormal(uint8_t* texel, const glm::vec3& normal);

/// The PNG file of a picture.
std::vector<uint8_t> encodePng(const Picture& picture);

}  // namespace lodestir::generate
