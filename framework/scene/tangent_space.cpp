// SPDX-License-Identifier: MIT
// Groups of triangle corners and their tangents.
#include <framework/scene/shading_frame.h>
#include <framework/scene/tangent_space.h>

#include <array>
#include <cmath>
#include <map>
#include <tuple>

namespace lodestir {
namespace {

/// How a triangle lies in the texture.
struct Face {
    glm::dvec3 alongU{0};  ///< direction of growing u, unit; zero where the texture coordinates span no area
    int sign = 0;          ///< of its area in the texture; 0: not known (yet), takes part in any group
    bool flat = true;      ///< without area in the texture
};

struct Edge {
    std::uint32_t face = none;
    int side = 0;  ///< from corner `side` to the next one
};

class TangentMaker {
public:
    TangentMaker(MeshLevel& level, const TextureSlot& slot) : level_(level), uv_(slot.uvSet == 1 ? level.uv1 : level.uv0), slot_(slot) {}

    void make() {
        weld();
        for (const glm::uvec3& t : level_.triangles) faces_.push_back(face(t));
        joinEdges();
        makeGroups();
        split();
    }

private:
    static constexpr std::uint32_t unassigned = none;

    void weld() {
        std::map<std::array<float, 8>, std::uint32_t> first;
        welded_.reserve(level_.positions.size());
        for (std::size_t v = 0; v < level_.positions.size(); ++v) {
            const glm::vec3 p = level_.positions[v] + 0.0f, n = level_.normals[v] + 0.0f;  // -0 becomes 0
            const glm::vec2 uv = uv_[v] + 0.0f;
            welded_.push_back(first.try_emplace({p.x, p.y, p.z, n.x, n.y, n.z, uv.x, uv.y}, static_cast<std::uint32_t>(v)).first->second);
        }
    }

    Face face(const glm::uvec3& t) const {
        const glm::dvec2 uv(transformUv(slot_, uv_[t.x]));
        const glm::dvec2 s = glm::dvec2(transformUv(slot_, uv_[t.y])) - uv, r = glm::dvec2(transformUv(slot_, uv_[t.z])) - uv;
        const glm::dvec3 p(level_.positions[t.x]), e = glm::dvec3(level_.positions[t.y]) - p, f = glm::dvec3(level_.positions[t.z]) - p;
        const double area = s.x * r.y - s.y * r.x;
        const glm::dvec3 along = (e * r.y - f * s.y) * (area < 0 ? -1.0 : 1.0);
        const double length = glm::length(along);
        if (area == 0 || !std::isfinite(area) || !(length > 0)) return {};
        return {along / length, area < 0 ? -1 : 1, false};
    }

    std::uint32_t at(std::uint32_t face, int corner) const { return welded_[level_.triangles[face][corner]]; }

    /// Each side of a triangle meets at most one other that runs the opposite way.
    void joinEdges() {
        std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<Edge>> open;
        neighbours_.resize(faces_.size());
        for (std::uint32_t i = 0; i < faces_.size(); ++i) {
            for (int side = 0; side < 3; ++side) {
                const std::uint32_t a = at(i, side), b = at(i, (side + 1) % 3);
                const auto other = open.find({b, a});
                if (other == open.end() || other->second.empty() || other->second.front().face == i) {
                    open[{a, b}].push_back({i, side});
                    continue;
                }
                const Edge met = other->second.front();
                other->second.erase(other->second.begin());
                neighbours_[i][static_cast<std::size_t>(side)] = met.face;
                neighbours_[met.face][static_cast<std::size_t>(met.side)] = i;
            }
        }
    }

    void makeGroups() {
        groups_.assign(faces_.size(), {unassigned, unassigned, unassigned});
        for (std::uint32_t i = 0; i < faces_.size(); ++i) {
            if (faces_[i].flat) continue;
            for (int c = 0; c < 3; ++c) {
                if (groups_[i][static_cast<std::size_t>(c)] == unassigned) growGroup(i, at(i, c), faces_[i].sign);
            }
        }
    }

    /// The group of the corner of `start` at the vertex: all that is reached over edges at the vertex without a change of orientation.
    void growGroup(std::uint32_t start, std::uint32_t vertex, int sign) {
        const auto group = static_cast<std::uint32_t>(tangents_.size());
        glm::dvec3 sum(0);
        std::vector<std::uint32_t> waiting{start};
        while (!waiting.empty()) {
            const std::uint32_t i = waiting.back();
            waiting.pop_back();
            int c = 0;
            while (c < 3 && at(i, c) != vertex) ++c;
            if (c == 3 || groups_[i][static_cast<std::size_t>(c)] != unassigned) continue;
            if (faces_[i].sign == 0) faces_[i].sign = sign;
            if (faces_[i].sign != sign) continue;
            groups_[i][static_cast<std::size_t>(c)] = group;
            sum += contribution(i, c);
            for (const int side : {c, (c + 2) % 3}) {
                const std::uint32_t next = neighbours_[i][static_cast<std::size_t>(side)];
                if (next != none) waiting.push_back(next);
            }
        }
        const glm::vec3 n = level_.normals[vertex];
        const double length = glm::length(sum);
        tangents_.emplace_back(length > 1e-12 ? glm::vec3(sum / length) : perpendicular(n), sign < 0 ? 1.0f : -1.0f);
    }

    /// The triangle's direction in the plane of the corner's normal, as long as its angle there.
    glm::dvec3 contribution(std::uint32_t i, int c) const {
        if (faces_[i].flat) return glm::dvec3(0);
        const glm::uvec3& t = level_.triangles[i];
        const glm::dvec3 n(level_.normals[t[c]]), p(level_.positions[t[c]]);
        const auto flattened = [&](const glm::dvec3& v) { return v - n * glm::dot(n, v); };
        const glm::dvec3 a = flattened(glm::dvec3(level_.positions[t[(c + 1) % 3]]) - p), b = flattened(glm::dvec3(level_.positions[t[(c + 2) % 3]]) - p);
        const glm::dvec3 direction = flattened(faces_[i].alongU);
        const double length = glm::length(direction);
        return length > 0 ? direction / length * std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)) : glm::dvec3(0);
    }

    /// Gives every vertex of the file one group, and further groups copies of it.
    void split() {
        const std::size_t count = level_.positions.size();
        std::vector<std::uint32_t> from(count), groupOf(count, unassigned);
        std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> copies;
        for (std::size_t v = 0; v < count; ++v) from[v] = static_cast<std::uint32_t>(v);
        for (std::uint32_t i = 0; i < faces_.size(); ++i) {
            for (int c = 0; c < 3; ++c) {
                std::uint32_t& v = level_.triangles[i][c];
                const std::uint32_t group = groups_[i][static_cast<std::size_t>(c)];
                if (group == unassigned || groupOf[v] == group) continue;  // a corner that no group found takes what its vertex has
                if (groupOf[v] == unassigned) {
                    groupOf[v] = group;
                    continue;
                }
                const auto [place, isNew] = copies.try_emplace({v, group}, static_cast<std::uint32_t>(from.size()));
                if (isNew) {
                    from.push_back(v);
                    groupOf.push_back(group);
                }
                v = place->second;
            }
        }
        level_.tangents.clear();
        if (from.size() > count) gatherVertices(level_, from);
        for (std::size_t v = 0; v < from.size(); ++v)
            level_.tangents.push_back(groupOf[v] == unassigned ? glm::vec4(perpendicular(level_.normals[v]), 1.0f) : tangents_[groupOf[v]]);
    }

    MeshLevel& level_;
    const std::vector<glm::vec2> uv_;
    const TextureSlot& slot_;
    std::vector<std::uint32_t> welded_;  ///< of each vertex: the first one that is the same
    std::vector<Face> faces_;
    struct Sides : std::array<std::uint32_t, 3> {
        Sides() : array{none, none, none} {}
        Sides(std::uint32_t a, std::uint32_t b, std::uint32_t c) : array{a, b, c} {}
    };
    std::vector<Sides> neighbours_, groups_;  ///< of each face: the face beyond each side, the group of each corner
    std::vector<glm::vec4> tangents_;         ///< of each group
};

}  // namespace

void makeTangents(MeshLevel& level, const TextureSlot& slot) {
    if ((slot.uvSet == 1 ? level.uv1 : level.uv0).empty()) {
        level.tangents.clear();
        for (const glm::vec3& n : level.normals) level.tangents.emplace_back(perpendicular(n), 1.0f);
        return;
    }
    TangentMaker(level, slot).make();
}

}  // namespace lodestir
