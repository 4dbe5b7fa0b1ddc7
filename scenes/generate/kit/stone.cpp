// SPDX-License-Identifier: MIT
// Broken rock: see stone.h.
#include "stone.h"

#include <algorithm>
#include <cmath>

#include "random.h"

namespace lodestir::generate {

namespace {

/// The six charts lie three by two in the atlas, apart by gutters that are this share of a chart on each side.
constexpr float gutter = 1.0f / 96.0f;
constexpr glm::ivec2 atlas{3, 2};

/// Right and up of a cube face; their cross product points out.
struct Face {
    glm::vec3 right, up;
    glm::vec3 out() const { return glm::cross(right, up); }
};
constexpr std::array<Face, 6> faces{{{{1, 0, 0}, {0, 1, 0}},
                                     {{0, 0, -1}, {0, 1, 0}},
                                     {{-1, 0, 0}, {0, 1, 0}},
                                     {{0, 0, 1}, {0, 1, 0}},
                                     {{1, 0, 0}, {0, 0, -1}},
                                     {{1, 0, 0}, {0, 0, 1}}}};

/// Evens out the solid angle of cube cells; exactly odd, and exactly 1 at 1, so that neighbouring faces meet bit for bit.
float warp(float x) {
    const float a = std::abs(x);
    const float w = a == 1 ? 1.0f : std::tan(a * 0.78539816f);
    return x < 0 ? -w : w;
}

glm::vec3 direction(const Face& face, float x, float y) { return glm::normalize(face.right * warp(x) - face.up * warp(y) + face.out()); }

glm::vec2 atlasUv(size_t face, const glm::vec2& chart) {
    const glm::vec2 cell(int(face) % atlas.x, int(face) / atlas.x);
    return (cell + gutter + chart * (1 - 2 * gutter)) / glm::vec2(atlas);
}

}  // namespace

Stone::Stone(uint32_t seed, const StoneForm& stoneForm) : form(stoneForm), noise{seed} {
    Random random(seed);
    bedding = glm::normalize(glm::vec3(random.between(-0.35f, 0.35f), 1, random.between(-0.35f, 0.35f)));
    for (int i = 0; i < form.facets; ++i) {
        // Spread by a Fibonacci lattice, then shaken: no two planes nearly alike, no large gap.
        const float y = 1 - (2 * float(i) + 1) / float(form.facets), r = std::sqrt(1 - y * y), phi = float(i) * 2.39996323f;
        const glm::vec3 shake(random.bell(), random.bell(), random.bell());
        planes.emplace_back(glm::normalize(glm::vec3(r * std::cos(phi), y, r * std::sin(phi)) + 0.22f * shake),
                            random.between(0.74f, 1.0f));
    }
}

StonePoint Stone::at(const glm::vec3& d, bool fine) const {
    // The block: a p-norm over the planes rounds their intersection; p is the sharpness of its edges.
    float sum = 0;
    for (const auto& [normal, distance] : planes) sum += std::pow(std::max(glm::dot(d, normal), 0.0f) / distance, form.sharpness);
    const glm::vec3 block = d * std::pow(sum, -1 / form.sharpness) * form.size;

    // Noise lives in a frame where the stone has a radius of about 1.4, whatever its size.
    const glm::vec3 p = block * (1.4f / std::max({form.size.x, form.size.y, form.size.z}));
    const glm::vec3 q = p + 0.28f * glm::vec3(noise.at(p * 1.1f), noise.at(p * 1.1f + 17.3f), noise.at(p * 1.1f + 41.9f));

    StonePoint point;
    point.crack = glm::smoothstep(0.80f, 0.97f, noise.ridged(q * glm::vec3(0.9f, 0.6f, 0.9f) + 7.0f, 2, 0.35f));
    point.layer = glm::dot(q, bedding) * 5.2f + 0.5f * noise.at(q * 1.7f + 3.0f);
    const float lumps = noise.fractal(q * 1.2f, 3, 0.5f);
    const float ridges = noise.ridged(q * 2.1f + 11.0f, fine ? 5 : 4, 0.5f) - 0.45f;

    // Beds weather back by different depths; the step from one to the next is short.
    const float bed = std::floor(point.layer), within = point.layer - bed;
    const auto hardness = [&](float k) { return unit(hash(noise.seed, uint32_t(int(k) + 1000))); };
    const float strata = glm::mix(hardness(bed), hardness(bed + 1), glm::smoothstep(0.72f, 1.0f, within)) - 0.5f;

    point.fine = fine ? noise.fractal(q * 11.0f, 4, 0.62f) : noise.fractal(q * 11.0f, 1);
    const float relief = 0.07f * lumps + 0.06f * ridges + 0.105f * strata - 0.085f * point.crack + 0.012f * point.fine;
    point.position = block * (1 + form.relief * relief);
    return point;
}

Mesh Stone::mesh(int n) const {
    Mesh mesh;
    for (size_t f = 0; f < faces.size(); ++f) {
        const auto base = uint32_t(mesh.vertices.size()), stride = uint32_t(n + 1);
        for (int y = 0; y <= n; ++y)
            for (int x = 0; x <= n; ++x) {
                const glm::vec2 lattice = glm::vec2(2 * x - n, 2 * y - n) / float(n);
                const glm::vec3 position = at(direction(faces[f], lattice.x, lattice.y), false).position;
                mesh.add({.position = position, .uv = atlasUv(f, glm::vec2(x, y) / float(n))});
            }
        for (uint32_t y = 0; y < uint32_t(n); ++y)
            for (uint32_t x = 0; x < uint32_t(n); ++x) {
                const uint32_t a = base + y * stride + x, b = a + stride, c = b + 1, d = a + 1;
                // The shorter diagonal keeps ridges from being cut across.
                const auto length = [&](uint32_t i, uint32_t j) {
                    return glm::distance(mesh.vertices[i].position, mesh.vertices[j].position);
                };
                if (length(a, c) < length(b, d))
                    mesh.quad(a, b, c, d);
                else
                    mesh.quad(b, c, d, a);
            }
    }
    computeNormals(mesh, 180);
    computeTangents(mesh);
    return mesh;
}

Surface Stone::weathered(const StonePoint& point, const glm::vec3& normal) const {
    const glm::vec3 p = point.position;
    const float bands = noise.fractal({point.layer * 0.9f, 0.3f * p.x, 0.3f * p.z}, 4, 0.6f);
    const float blotch = noise.fractal(p * 1.6f + 23.0f, 4);
    const float speckle = noise.fractal(p * 60.0f, 2, 0.7f);

    Surface s;
    s.color = glm::mix(glm::vec3(0.36f, 0.295f, 0.225f), glm::vec3(0.20f, 0.172f, 0.15f), glm::smoothstep(-0.45f, 0.45f, bands));
    s.color = glm::mix(s.color, glm::vec3(0.40f, 0.215f, 0.09f), 0.6f * glm::smoothstep(0.12f, 0.5f, blotch));  // iron stains
    s.color *= 1 + 0.22f * speckle + 0.30f * point.fine;
    s.color *= 1 - 0.62f * point.crack;
    s.roughness = 0.84f + 0.08f * speckle - 0.10f * glm::smoothstep(0.2f, 0.6f, blotch);

    // Lichen grows in round, ragged patches on open faces; moss where water stays: on ledges, in cracks, near the ground.
    const glm::vec3 ragged = p + 0.05f * glm::vec3(noise.fractal(p * 12.0f, 2, 0.7f), noise.fractal(p * 12.0f + 9.0f, 2, 0.7f), point.fine);
    const auto lichen = [&](float scale, float share, uint32_t kind) {
        const Cell cell = Noise{noise.seed + kind}.cell(ragged * scale);
        const float size = 0.18f + 0.32f * unit(hash(cell.id, 5));
        const bool grows = unit(hash(cell.id, kind)) < share;
        return grows ? (1 - glm::smoothstep(size * 0.75f, size, cell.nearest)) * (0.75f + 0.25f * std::sin(cell.nearest * 42)) : 0.0f;
    };
    const float open = (1 - point.crack) * glm::smoothstep(-0.35f, 0.15f, normal.y);
    const float pale = lichen(3.2f, 0.55f, 11) * open, orange = lichen(5.5f, 0.22f, 12) * open;
    s.color = glm::mix(s.color, glm::vec3(0.47f, 0.48f, 0.37f) * (1 + 0.3f * speckle), 0.8f * pale);
    s.color = glm::mix(s.color, glm::vec3(0.56f, 0.27f, 0.035f) * (1 + 0.3f * speckle), 0.85f * orange);

    const float damp = noise.fractal(p * 2.3f + 51.0f, 5, 0.6f) + 0.75f * glm::smoothstep(0.35f, 0.95f, normal.y) + 0.35f * point.crack -
                       0.55f * glm::smoothstep(-0.9f, 0.9f, p.y / form.size.y);
    const float moss = glm::smoothstep(0.42f, 0.62f, damp);
    s.color = glm::mix(s.color, glm::vec3(0.070f, 0.088f, 0.018f) * (1 + 0.9f * noise.at(p * 40.0f) + 0.4f * speckle), 0.9f * moss);
    s.roughness = glm::mix(s.roughness, 0.97f, std::max({pale, orange, moss}));
    s.color = glm::max(s.color, glm::vec3(0.004f));
    return s;
}

Textures Stone::bake(const Mesh& mesh, int chartTexels) const {
    const glm::ivec2 size = atlas * chartTexels;
    Textures textures{Picture(size.x, size.y, 3), Picture(size.x, size.y, 3), Picture(size.x, size.y, 3)};

    // The full relief at every texel of a chart and one beyond; gutters continue over the edge of the cube, as the surface does.
    struct Frame {
        glm::vec3 normal{0};
        glm::vec4 tangent{0};
    };
    std::vector<Frame> frames(size_t(size.x) * size_t(size.y));
    for (size_t i = 0; i < mesh.indices.size(); i += 3) {
        const Vertex* v[3];
        glm::vec2 t[3];
        for (size_t k = 0; k < 3; ++k) {
            v[k] = &mesh.vertices[mesh.indices[i + k]];
            t[k] = v[k]->uv * glm::vec2(size) - 0.5f;
        }
        const glm::vec2 e = t[1] - t[0], f = t[2] - t[0];
        const float area = e.x * f.y - e.y * f.x;
        if (area == 0) continue;
        const glm::ivec2 low = glm::ivec2(glm::floor(glm::min(t[0], glm::min(t[1], t[2])))),
                         high = glm::ivec2(glm::ceil(glm::max(t[0], glm::max(t[1], t[2]))));
        for (int y = std::max(low.y, 0); y <= std::min(high.y, size.y - 1); ++y)
            for (int x = std::max(low.x, 0); x <= std::min(high.x, size.x - 1); ++x) {
                const glm::vec2 g = glm::vec2(x, y) - t[0];
                const float b = (g.x * f.y - g.y * f.x) / area, c = (e.x * g.y - e.y * g.x) / area, a = 1 - b - c;
                if (std::min({a, b, c}) < -1e-3f) continue;
                frames[size_t(y) * size_t(size.x) + size_t(x)] = {a * v[0]->normal + b * v[1]->normal + c * v[2]->normal,
                                                                  a * v[0]->tangent + b * v[1]->tangent + c * v[2]->tangent};
            }
    }

    const int border = chartTexels + 2;
    std::vector<StonePoint> points(size_t(border) * size_t(border));
    for (size_t f = 0; f < faces.size(); ++f) {
        const glm::ivec2 origin = glm::ivec2(int(f) % atlas.x, int(f) / atlas.x) * chartTexels;
        for (int y = 0; y < border; ++y)
            for (int x = 0; x < border; ++x) {
                const glm::vec2 chart = ((glm::vec2(x, y) - 0.5f) / float(chartTexels) - gutter) / (1 - 2 * gutter);
                points[size_t(y) * size_t(border) + size_t(x)] = at(direction(faces[f], 2 * chart.x - 1, 2 * chart.y - 1), true);
            }
        const int inset = int(gutter * float(chartTexels)) + 1;
        for (int y = 0; y < chartTexels; ++y)
            for (int x = 0; x < chartTexels; ++x) {
                const auto point = [&](int dx, int dy) { return points[size_t(y + 1 + dy) * size_t(border) + size_t(x + 1 + dx)]; };
                const glm::vec3 right = point(1, 0).position - point(-1, 0).position, down = point(0, 1).position - point(0, -1).position;
                const glm::vec3 normal = glm::normalize(glm::cross(down, right));
                const glm::ivec2 texel = origin + glm::ivec2(x, y);

                // In the gutter the frame of the nearest texel inside the chart serves.
                const glm::ivec2 inside = origin + glm::clamp(glm::ivec2(x, y), inset, chartTexels - 1 - inset);
                const Frame& frame = frames[size_t(inside.y) * size_t(size.x) + size_t(inside.x)];
                const Frame& own = frames[size_t(texel.y) * size_t(size.x) + size_t(texel.x)];
                const Frame& used = own.normal == glm::vec3(0) ? frame : own;
                const glm::vec3 n = glm::normalize(used.normal),
                                t = glm::normalize(glm::vec3(used.tangent) - n * glm::dot(n, glm::vec3(used.tangent)));
                const glm::vec3 b = glm::cross(n, t) * (used.tangent.w < 0 ? -1.0f : 1.0f);
                const glm::vec3 bump(glm::dot(normal, t), glm::dot(normal, b), std::max(glm::dot(normal, n), 0.15f));
                writeNormal(textures.normal.at(texel.x, texel.y), glm::normalize(bump));

                const Surface s = weathered(point(0, 0), normal);
                uint8_t *color = textures.color.at(texel.x, texel.y), *rough = textures.roughness.at(texel.x, texel.y);
                for (int k = 0; k < 3; ++k) color[k] = encodeSrgb(s.color[k]);
                rough[0] = 255;
                rough[1] = encodeUnit(s.roughness);
                rough[2] = 0;
            }
    }
    return textures;
}

}  // namespace lodestir::generate
