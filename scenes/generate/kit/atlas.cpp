// SPDX-License-Identifier: MIT
// Charts and what is painted on them: see atlas.h.
#include "atlas.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numeric>
#include <unordered_map>
#include <utility>
#include <vector>

#include "random.h"

namespace lodestir::generate {

namespace {

constexpr int gutter = 6;          ///< least texels around a chart that are as its border is, so that filters find no other chart
constexpr float steepest = 0.35f;  ///< cosine to its axis up to which a triangle may join its neighbours' chart

/// Axis 2k is +k, 2k + 1 is -k. right x up = axis, so that no chart is mirrored.
glm::vec3 axisOf(int label) {
    glm::vec3 axis(0);
    axis[label / 2] = label % 2 ? -1.0f : 1.0f;
    return axis;
}
glm::vec2 projected(int label, const glm::vec3& p) {
    const glm::vec3 up = label / 2 == 1 ? glm::vec3(0, 0, 1) : glm::vec3(0, 1, 0), right = glm::cross(up, axisOf(label));
    return {glm::dot(right, p), -glm::dot(up, p)};
}

struct Triangles {
    std::vector<glm::vec3> normals;
    std::vector<std::array<int, 3>> neighbours;  ///< across each edge, or -1
};

Triangles trianglesOf(const Mesh& mesh) {
    // Vertices that were split for their UVs or normals are one place again.
    struct PlaceHash {
        size_t operator()(const glm::ivec3& p) const { return hash(uint32_t(p.x), uint32_t(p.y), uint32_t(p.z)); }
    };
    std::unordered_map<glm::ivec3, uint32_t, PlaceHash> places;
    std::vector<uint32_t> placeOf;
    for (const Vertex& v : mesh.vertices)
        placeOf.push_back(places.try_emplace(glm::ivec3(glm::round(v.position * 1e5f)), uint32_t(places.size())).first->second);

    Triangles triangles;
    std::unordered_map<uint64_t, int> open;
    for (int t = 0; t < int(mesh.triangleCount()); ++t) {
        const auto corner = [&](int k) { return mesh.indices[size_t(3 * t + k % 3)]; };
        const auto at = [&](int k) { return mesh.vertices[corner(k)].position; };
        const glm::vec3 n = glm::cross(at(1) - at(0), at(2) - at(0));
        triangles.normals.push_back(glm::length(n) > 0 ? glm::normalize(n) : mesh.vertices[corner(0)].normal);
        triangles.neighbours.push_back({-1, -1, -1});
        for (int k = 0; k < 3; ++k) {
            const uint64_t a = placeOf[corner(k)], b = placeOf[corner(k + 1)];
            const auto found = open.find(b << 32 | a);
            if (found == open.end()) {
                open[a << 32 | b] = 3 * t + k;
                continue;
            }
            triangles.neighbours[size_t(t)][size_t(k)] = found->second / 3;
            triangles.neighbours[size_t(found->second / 3)][size_t(found->second % 3)] = t;
            open.erase(found);
        }
    }
    return triangles;
}

/// The axis that each triangle faces; borders straightened by a vote of neighbours.
std::vector<int> labelled(const Triangles& triangles) {
    const auto facing = [&](size_t t, int label) { return glm::dot(triangles.normals[t], axisOf(label)); };
    std::vector<int> labels(triangles.normals.size());
    for (size_t t = 0; t < labels.size(); ++t)
        for (int label = 1; label < 6; ++label)
            if (facing(t, label) > facing(t, labels[t])) labels[t] = label;
    for (int round = 0; round < 16; ++round)
        for (size_t t = 0; t < labels.size(); ++t) {
            std::array<int, 6> votes{};
            for (int n : triangles.neighbours[t])
                if (n >= 0) ++votes[size_t(labels[size_t(n)])];
            for (int label = 0; label < 6; ++label)
                if (votes[size_t(label)] >= 2 && facing(t, label) > steepest) labels[t] = label;
        }
    return labels;
}

/// Connected pieces of one label: the chart of each triangle. Those of a few triangles go to the neighbour with the longest border, if they face its way.
std::vector<int> piecesOf(const Triangles& triangles, std::vector<int>& labels, int smallest) {
    std::vector<int> pieces;
    for (int round = 0; round < 4; ++round) {
        pieces.assign(labels.size(), -1);
        int count = 0;
        bool changed = false;
        for (size_t seed = 0; seed < labels.size(); ++seed) {
            if (pieces[seed] >= 0) continue;
            std::vector<size_t> members{seed};
            std::map<int, int> borders;
            pieces[seed] = count++;
            for (size_t i = 0; i < members.size(); ++i)
                for (int n : triangles.neighbours[members[i]]) {
                    if (n < 0) continue;
                    if (labels[size_t(n)] != labels[seed])
                        ++borders[labels[size_t(n)]];
                    else if (pieces[size_t(n)] < 0)
                        pieces[size_t(n)] = pieces[seed], members.push_back(size_t(n));
                }
            if (int(members.size()) >= smallest || borders.empty()) continue;
            const int other = std::ranges::max_element(borders, {}, [](const auto& b) { return b.second; })->first;
            if (std::ranges::any_of(members, [&](size_t t) { return glm::dot(triangles.normals[t], axisOf(other)) < 0.1f; })) continue;
            for (size_t t : members) labels[t] = other;
            changed = true;
        }
        if (!changed) break;
    }
    return pieces;
}

struct Chart {
    int label = 0;
    glm::vec2 low{1e9f}, high{-1e9f};
    glm::vec2 corner{0};  ///< upper left in the picture, texels
};

/// Charts on shelves of falling height, `scale` texels a metre; false where they need more than the picture.
bool shelve(std::vector<Chart>& charts, float scale, int texels) {
    std::vector<size_t> order(charts.size());
    std::iota(order.begin(), order.end(), size_t(0));
    const auto size = [&](size_t i) { return glm::ceil((charts[i].high - charts[i].low) * scale) + float(2 * gutter); };
    std::ranges::stable_sort(order, [&](size_t a, size_t b) { return size(a).y > size(b).y; });
    glm::vec2 pen(0);
    float shelf = 0;
    for (size_t i : order) {
        const glm::vec2 s = size(i);
        if (pen.x + s.x > float(texels)) pen = {0, pen.y + shelf}, shelf = 0;
        shelf = std::max(shelf, s.y);
        if (s.x > float(texels) || pen.y + s.y > float(texels)) return false;
        charts[i].corner = pen + float(gutter);
        pen.x += s.x;
    }
    return true;
}

}  // namespace

Mesh charted(const Mesh& mesh, int texels, int smallest) {
    const Triangles triangles = trianglesOf(mesh);
    std::vector<int> labels = labelled(triangles);
    const std::vector<int> pieces = piecesOf(triangles, labels, smallest);

    std::vector<Chart> charts(size_t(*std::ranges::max_element(pieces) + 1));
    for (size_t t = 0; t < pieces.size(); ++t)
        for (size_t k = 0; k < 3; ++k) {
            Chart& chart = charts[size_t(pieces[t])];
            const glm::vec2 p = projected(labels[t], mesh.vertices[mesh.indices[3 * t + k]].position);
            chart.label = labels[t];
            chart.low = glm::min(chart.low, p), chart.high = glm::max(chart.high, p);
        }
    float small = 0, large = 1e6f;  // texels a metre: the most that find room
    for (int i = 0; i < 40; ++i) {
        const float scale = 0.5f * (small + large);
        (shelve(charts, scale, texels) ? small : large) = scale;
    }
    shelve(charts, small, texels);

    Mesh result;
    std::unordered_map<uint64_t, uint32_t> split;
    for (size_t t = 0; t < pieces.size(); ++t) {
        const Chart& chart = charts[size_t(pieces[t])];
        for (size_t k = 0; k < 3; ++k) {
            const uint32_t index = mesh.indices[3 * t + k];
            const auto [entry, fresh] = split.try_emplace(uint64_t(pieces[t]) << 32 | index, uint32_t(result.vertices.size()));
            if (fresh) {
                Vertex v = mesh.vertices[index];
                v.uv = (chart.corner + (projected(chart.label, v.position) - chart.low) * small) / float(texels);
                result.vertices.push_back(v);
            }
            result.indices.push_back(entry->second);
        }
    }
    computeTangents(result);
    return result;
}

Textures bake(const Mesh& charted, int texels, const std::function<Surface(const glm::vec3&, const glm::vec3&)>& surface) {
    struct Texel {
        Surface surface;
        glm::vec3 normal{0, 0, 1};
        bool isPainted = false;
    };
    std::vector<Texel> canvas(size_t(texels) * size_t(texels));
    const auto at = [&](int x, int y) -> Texel& { return canvas[size_t(y) * size_t(texels) + size_t(x)]; };
    for (size_t i = 0; i < charted.indices.size(); i += 3) {
        const Vertex* v[3];
        glm::vec2 t[3];
        for (size_t k = 0; k < 3; ++k) v[k] = &charted.vertices[charted.indices[i + k]], t[k] = v[k]->uv * float(texels) - 0.5f;
        const glm::vec2 e = t[1] - t[0], f = t[2] - t[0];
        const float area = e.x * f.y - e.y * f.x;
        if (area == 0) continue;
        // Metres of a texel: the projection keeps lengths along the picture.
        const float step = glm::distance(v[0]->position, v[1]->position) / std::max(glm::length(e), 1e-6f);
        const glm::ivec2 low(glm::floor(glm::min(t[0], glm::min(t[1], t[2])))), high(glm::ceil(glm::max(t[0], glm::max(t[1], t[2]))));
        for (int y = std::max(low.y, 0); y <= std::min(high.y, texels - 1); ++y)
            for (int x = std::max(low.x, 0); x <= std::min(high.x, texels - 1); ++x) {
                Texel& texel = at(x, y);
                const glm::vec2 g = glm::vec2(x, y) - t[0];
                const float b = (g.x * f.y - g.y * f.x) / area, c = (e.x * g.y - e.y * g.x) / area, a = 1 - b - c;
                if (texel.isPainted || std::min({a, b, c}) < -1e-3f) continue;
                const auto mean = [&](auto member) { return a * glm::vec3(v[0]->*member) + b * glm::vec3(v[1]->*member) + c * glm::vec3(v[2]->*member); };
                const glm::vec3 p = mean(&Vertex::position), n = glm::normalize(mean(&Vertex::normal));
                const glm::vec3 along = mean(&Vertex::tangent), tangent = glm::normalize(along - n * glm::dot(n, along)),
                                up = glm::cross(n, tangent) * v[0]->tangent.w;
                texel.surface = surface(p, n);
                const auto rise = [&](const glm::vec3& d) { return (surface(p + step * d, n).height - texel.surface.height) / step; };
                texel.normal = glm::normalize(glm::vec3(-rise(tangent), -rise(up), 1));
                texel.isPainted = true;
            }
    }
    // What no chart covers is as the nearest one that grows into it: coarse mipmaps mix in all that lies around a chart.
    std::vector<glm::ivec2> open;
    for (int y = 0; y < texels; ++y)
        for (int x = 0; x < texels; ++x)
            if (at(x, y).isPainted) open.emplace_back(x, y);
    for (size_t i = 0; i < open.size(); ++i)
        for (const glm::ivec2& d : {glm::ivec2(1, 0), glm::ivec2(-1, 0), glm::ivec2(0, 1), glm::ivec2(0, -1)}) {
            const glm::ivec2 q = glm::clamp(open[i] + d, 0, texels - 1);
            if (at(q.x, q.y).isPainted) continue;
            at(q.x, q.y) = at(open[i].x, open[i].y);
            open.push_back(q);
        }

    Textures textures{Picture(texels, texels, 3), Picture(texels, texels, 3), Picture(texels, texels, 3)};
    for (int y = 0; y < texels; ++y)
        for (int x = 0; x < texels; ++x) {
            const Texel& texel = at(x, y);
            uint8_t *color = textures.color.at(x, y), *rough = textures.roughness.at(x, y);
            for (int k = 0; k < 3; ++k) color[k] = encodeSrgb(texel.surface.color[k]);
            writeNormal(textures.normal.at(x, y), texel.normal);
            rough[0] = 255;
            rough[1] = encodeUnit(texel.surface.roughness);
            rough[2] = encodeUnit(texel.surface.metalness);
        }
    return textures;
}

}  // namespace lodestir::generate
