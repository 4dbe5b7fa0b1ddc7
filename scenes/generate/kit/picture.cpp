// SPDX-License-Identifier: MIT
// Texture painting: see picture.h.
#include "picture.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#include <stb/stb_image_write.h>
#pragma GCC diagnostic pop

#include "shapes.h"

namespace lodestir::generate {

uint8_t encodeSrgb(float linear) {
    const float x = std::clamp(linear, 0.0f, 1.0f);
    const float encoded = x <= 0.0031308f ? 12.92f * x : 1.055f * std::pow(x, 1 / 2.4f) - 0.055f;
    return uint8_t(std::lround(encoded * 255));
}

uint8_t encodeUnit(float value) { return uint8_t(std::lround(std::clamp(value, 0.0f, 1.0f) * 255)); }

void writeNormal(uint8_t* texel, const glm::vec3& normal) {
    for (int k = 0; k < 3; ++k) texel[k] = encodeUnit(normal[k] * 0.5f + 0.5f);
}

namespace {

/// Turns surface points into pictures; `normalAt(x, y)` is asked only where heights vary.
Textures develop(int width, int height, const std::vector<Surface>& points, bool smooth,
                 const std::function<glm::vec3(int, int)>& normalAt) {
    const auto differs = [&](auto member) {
        return std::any_of(points.begin(), points.end(), [&](const Surface& s) { return s.*member != points.front().*member; });
    };
    const bool cut = differs(&Surface::alpha);
    const bool bumpy = !smooth && differs(&Surface::height);
    const bool varied = differs(&Surface::roughness) || differs(&Surface::metalness);

    Textures textures;
    textures.color = Picture(width, height, cut ? 4 : 3);
    if (bumpy) textures.normal = Picture(width, height, 3);
    if (varied) textures.roughness = Picture(width, height, 3);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const Surface& s = points[size_t(y) * size_t(width) + size_t(x)];
            uint8_t* color = textures.color.at(x, y);
            for (int k = 0; k < 3; ++k) color[k] = encodeSrgb(s.color[k]);
            if (cut) color[3] = encodeUnit(s.alpha);
            if (bumpy) writeNormal(textures.normal.at(x, y), normalAt(x, y));
            if (varied) {
                uint8_t* out = textures.roughness.at(x, y);
                out[0] = 255;  // occlusion, unused: light is traced
                out[1] = encodeUnit(s.roughness);
                out[2] = encodeUnit(s.metalness);
            }
        }
    return textures;
}

}  // namespace

Textures paint(const Canvas& canvas, const std::function<Surface(const glm::vec2&)>& surface) {
    const int w = canvas.width, h = canvas.height;
    const glm::vec2 texel = canvas.metres / glm::vec2(w, h);
    std::vector<Surface> points(size_t(w) * size_t(h));
    for (int y = 0; y < h; ++y)
        for (int x = 0; x < w; ++x) points[size_t(y) * size_t(w) + size_t(x)] = surface((glm::vec2(x, y) + 0.5f) * texel);

    const auto heightAt = [&](int x, int y) {
        x = canvas.repeats ? (x + w) % w : std::clamp(x, 0, w - 1);
        y = canvas.repeats ? (y + h) % h : std::clamp(y, 0, h - 1);
        return points[size_t(y) * size_t(w) + size_t(x)].height;
    };
    return develop(w, h, points, canvas.smooth, [&](int x, int y) {
        const float slopeX = (heightAt(x + 1, y) - heightAt(x - 1, y)) / (2 * texel.x);
        const float slopeY = (heightAt(x, y + 1) - heightAt(x, y - 1)) / (2 * texel.y);
        return glm::normalize(glm::vec3(-slopeX, slopeY, 1));  // y runs down, +Y of a normal picture up
    });
}

Textures paintSphere(int width, int height, const std::function<Surface(const glm::vec3&)>& surface) {
    std::vector<Surface> points(size_t(width) * size_t(height));
    const auto direction = [&](int x, int y) { return sphereDirection((glm::vec2(x, y) + 0.5f) / glm::vec2(width, height)); };
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) points[size_t(y) * size_t(width) + size_t(x)] = surface(direction(x, y));

    const auto heightAt = [&](int x, int y) {
        return points[size_t(std::clamp(y, 0, height - 1)) * size_t(width) + size_t((x + width) % width)].height;
    };
    const float step = 3.14159265f / float(height), turn = 2 * 3.14159265f / float(width);
    return develop(width, height, points, false, [&](int x, int y) {
        // Texels shrink towards the poles with the sine of the polar angle; the slope is that on the sphere itself.
        const float girth = std::sin((float(y) + 0.5f) * step);
        const float slopeEast = (heightAt(x + 1, y) - heightAt(x - 1, y)) / (2 * turn * girth);
        const float slopeSouth = (heightAt(x, y + 1) - heightAt(x, y - 1)) / (2 * step);
        return glm::normalize(glm::vec3(-slopeEast, slopeSouth, 1));
    });
}

std::vector<uint8_t> encodePng(const Picture& picture) {
    std::vector<uint8_t> file;
    const auto append = [](void* context, void* data, int size) {
        const auto* bytes = static_cast<const uint8_t*>(data);
        static_cast<std::vector<uint8_t>*>(context)->insert(static_cast<std::vector<uint8_t>*>(context)->end(), bytes, bytes + size);
    };
    if (!stbi_write_png_to_func(append, &file, picture.width, picture.height, picture.channels, picture.bytes.data(),
                                picture.width * picture.channels))
        throw std::runtime_error("a picture could not be encoded as PNG (out of memory)");
    return file;
}

}  // namespace lodestir::generate
