// SPDX-License-Identifier: MIT
#include <framework/scene/lod/wedges.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <unordered_map>

namespace lodestir {
namespace {

/// Numbers that have to agree bit for bit; -0 is made 0.
template <std::size_t N> struct Key {
    std::array<std::uint32_t, N> words{};
    std::size_t count = 0;
    void add(float value) { words[count++] = std::bit_cast<std::uint32_t>(value == 0 ? 0.0f : value); }
    void add(std::uint32_t value) { words[count++] = value; }
    bool operator==(const Key&) const = default;
};

struct KeyHash {
    template <std::size_t N> std::size_t operator()(const Key<N>& key) const {
        std::uint64_t h = 0xcbf29ce484222325ull;
        for (std::uint32_t word : key.words) h = std::rotl((h ^ word) * 0x9e3779b97f4a7c15ull, 29);
        return std::size_t(h);
    }
};

int signOf(double value) { return value > 0 ? 1 : value < 0 ? -1 : 0; }
bool isFinite(const glm::vec3& p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

}  // namespace

double uvArea(const glm::vec2& a, const glm::vec2& b, const glm::vec2& c) {
    const glm::dvec2 e = glm::dvec2(b) - glm::dvec2(a), f = glm::dvec2(c) - glm::dvec2(a);
    return e.x * f.y - e.y * f.x;
}

Wedges::Wedges(const MeshLevel& surface) {
    const auto orientation = [&](const glm::uvec3& t) {
        return surface.uv0.empty() ? 0 : signOf(uvArea(surface.uv0[t.x], surface.uv0[t.y], surface.uv0[t.z]));
    };
    std::vector<std::array<bool, 2>> seen(surface.positions.size());  // is the vertex a corner of a triangle that runs right, or left?
    for (const glm::uvec3& t : surface.triangles)
        for (int k = 0; k < 3; ++k)
            if (const int sign = orientation(t)) seen[t[k]][sign < 0] = true;

    std::unordered_map<Key<3>, std::uint32_t, KeyHash> knownPlaces;
    std::unordered_map<Key<11>, std::uint32_t, KeyHash> knownWedges;
    const auto wedgeOf = [&](std::uint32_t vertex, std::uint32_t group, int sign) {
        if (sign == 0) sign = seen[vertex][0] ? 1 : seen[vertex][1] ? -1 : 0;  // a sliver of the chart goes with what is around it
        Key<3> place;
        for (int i = 0; i < 3; ++i) place.add(surface.positions[vertex][i]);
        Key<11> key;
        key.add(knownPlaces.try_emplace(place, std::uint32_t(knownPlaces.size())).first->second);
        for (const auto* values : {&surface.uv0, &surface.uv1})
            for (int i = 0; i < 2; ++i) key.add(values->empty() ? 0.0f : (*values)[vertex][i]);
        for (int i = 0; i < 4; ++i) key.add(surface.colors.empty() ? 1.0f : surface.colors[vertex][i]);
        key.add(group);
        key.add(std::uint32_t(sign));
        const auto [entry, isNew] = knownWedges.try_emplace(key, std::uint32_t(positions.size()));
        if (isNew) {
            places.push_back(key.words[0]);
            positions.push_back(surface.positions[vertex]);
            uvs.push_back(surface.uv0.empty() ? glm::vec2(0) : surface.uv0[vertex]);
            orientations.push_back(sign);
            groups.push_back(group);
            vertices.emplace_back();
        }
        auto& all = vertices[entry->second];
        if (std::ranges::find(all, vertex) == all.end()) all.push_back(vertex);
        return entry->second;
    };
    for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
        const glm::uvec3 corners = surface.triangles[t];
        if (!isFinite(surface.positions[corners.x]) || !isFinite(surface.positions[corners.y]) || !isFinite(surface.positions[corners.z]))
            continue;
        const int sign = orientation(corners);
        glm::uvec3 w;
        for (int k = 0; k < 3; ++k) w[k] = wedgeOf(corners[k], surface.materials[t], sign);
        if (places[w.x] != places[w.y] && places[w.y] != places[w.z] && places[w.z] != places[w.x]) triangles.push_back(w);
    }
    placeCount = knownPlaces.size();
}

}  // namespace lodestir
