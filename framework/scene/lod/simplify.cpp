// SPDX-License-Identifier: MIT
#include <framework/scene/lod/simplify.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>

namespace lodestir {
namespace {

constexpr double borderWeight = 4;        ///< of the squared length of an edge of a border, beside the area of triangles
constexpr double shortnessWeight = 1e-5;  ///< of the squared way that a place goes: decides only where all else is flat
constexpr double mostTurn = 0.2;          ///< cosine: a triangle turned by more in one step is as good as turned over

std::uint64_t edgeKey(std::uint32_t a, std::uint32_t b) { return std::uint64_t(a) << 32 | b; }

bool holds(const std::vector<std::uint32_t>& values, std::uint32_t value) { return std::ranges::find(values, value) != values.end(); }

}  // namespace

Simplifier::Simplifier(const MeshLevel& surface)
    : surface_(surface),
      wedges_(surface),
      box_(boundsOfTriangles(surface)),
      extent_(std::max<double>(box_.isEmpty() ? 0 : glm::length(box_.high - box_.low), std::numeric_limits<float>::min())),
      appearance_(surface, Appearance::all & ~unsigned(Appearance::uv0)),
      attributes_(wedges_.positions.size(), appearance_.size()),
      triangles_(wedges_.triangles),
      dead_(triangles_.size(), false),
      around_(wedges_.placeCount),
      held_(wedges_.placeCount, false),
      ages_(wedges_.placeCount, 0),
      alive_(triangles_.size()) {
    for (std::uint32_t t = 0; t < triangles_.size(); ++t)
        for (int k = 0; k < 3; ++k) around_[wedges_.places[triangles_[t][k]]].push_back(t);
    addQuadrics();
    findBorders();
    for (std::uint32_t place = 0; place < around_.size(); ++place) plan(place);
}

/// Positions are taken from the middle and, as attributes are, scaled to the extent; a UV unit is as long as it is on the surface on average.
void Simplifier::addQuadrics() {
    const double uvUnit = uvLength(surface_, surface_.uv0);
    const glm::dvec3 middle = 0.5 * (glm::dvec3(box_.low) + glm::dvec3(box_.high));
    for (std::size_t w = 0; w < wedges_.positions.size(); ++w) {
        const glm::dvec3 p = (glm::dvec3(wedges_.positions[w]) - middle) / extent_;
        const glm::dvec2 uv = glm::dvec2(wedges_.uvs[w]) * (uvUnit / extent_);
        points_.push_back({p.x, p.y, p.z, uv.x, uv.y});
    }
    quadrics_.resize(points_.size());
    for (const glm::uvec3& t : triangles_) {
        const glm::dvec3 a(wedges_.positions[t.x]), b(wedges_.positions[t.y]), c(wedges_.positions[t.z]);
        const double weight = glm::length(glm::cross(b - a, c - a)) / (extent_ * extent_);
        const Quadric quadric = Quadric::ofTriangle(points_[t.x], points_[t.y], points_[t.z], weight);
        for (int k = 0; k < 3; ++k) quadrics_[t[k]] += quadric;
        if (attributes_.attributes() == 0) continue;
        // At a hard edge shape tells enough: what is shaded flat has the normals of its faces.
        const bool hard = isHard(t.x) || isHard(t.y) || isHard(t.z);
        const auto place = [&](std::uint32_t w) { return glm::dvec3(points_[w][0], points_[w][1], points_[w][2]); };
        attributes_.addTriangle(
            t, {place(t.x), place(t.y), place(t.z)}, weight, hard ? appearance_.frameSize() : 0,
            [&](int corner, std::size_t j) { return appearance_.of(wedges_.vertices[t[corner]].front())[j] / extent_; });
    }
}

/// Has the wedge more than one normal or tangent?
bool Simplifier::isHard(std::uint32_t wedge) const {
    const std::vector<std::uint32_t>& all = wedges_.vertices[wedge];
    return std::ranges::any_of(all, [&](std::uint32_t v) {
        return !std::ranges::equal(appearance_.of(v).first(appearance_.frameSize()),
                                   appearance_.of(all.front()).first(appearance_.frameSize()));
    });
}

/// The wedge's vertex that looks most like another.
std::uint32_t Simplifier::vertexLike(std::uint32_t wedge, std::uint32_t vertex) const {
    return *std::ranges::min_element(wedges_.vertices[wedge], {}, [&](std::uint32_t v) {
        double sum = 0;
        for (std::size_t j = 0; j < appearance_.frameSize(); ++j) {
            const double difference = appearance_.of(v)[j] - appearance_.of(vertex)[j];
            sum += difference * difference;
        }
        return sum;
    });
}

/// What it costs that the surface of a wedge gets the looks of another.
double Simplifier::attributeCost(std::uint32_t wedge, std::uint32_t target) const {
    if (attributes_.attributes() == 0) return 0;
    std::array<double, Appearance::most> looks;
    const auto values = appearance_.of(vertexLike(target, wedges_.vertices[wedge].front()));
    for (std::size_t j = 0; j < values.size(); ++j) looks[j] = values[j] / extent_;
    const glm::dvec3 place(points_[target][0], points_[target][1], points_[target][2]);
    const auto span = std::span(looks).first(values.size());
    return attributes_.at(wedge, place, span) + attributes_.at(target, place, span);
}

/// Borders of charts, groups and the surface pull their ends back to themselves; edges of more than two triangles hold their ends.
void Simplifier::findBorders() {
    std::unordered_map<std::uint64_t, int> halfEdges, edges;  // between wedges, between places
    for (const glm::uvec3& t : triangles_)
        for (int k = 0; k < 3; ++k) {
            const std::uint32_t a = t[k], b = t[(k + 1) % 3], p = wedges_.places[a], q = wedges_.places[b];
            ++halfEdges[edgeKey(a, b)];
            if (++edges[edgeKey(std::min(p, q), std::max(p, q))] > 2) held_[p] = held_[q] = true;
        }
    for (const glm::uvec3& t : triangles_)
        for (int k = 0; k < 3; ++k) {
            const std::uint32_t a = t[k], b = t[(k + 1) % 3];
            if (halfEdges.contains(edgeKey(b, a))) continue;
            double length = 0;
            for (std::size_t i = 0; i < 3; ++i) length += (points_[b][i] - points_[a][i]) * (points_[b][i] - points_[a][i]);
            const Quadric quadric = Quadric::ofEdge(points_[a], points_[b], borderWeight * length);
            quadrics_[a] += quadric;
            quadrics_[b] += quadric;
        }
}

/// The triangle's wedge at a place; `none` when it has no corner there.
std::uint32_t Simplifier::cornerAt(std::uint32_t triangle, std::uint32_t place) const {
    for (int k = 0; k < 3; ++k)
        if (wedges_.places[triangles_[triangle][k]] == place) return triangles_[triangle][k];
    return none;
}

std::vector<std::uint32_t> Simplifier::neighbours(std::uint32_t place) const {
    std::vector<std::uint32_t> result;
    for (std::uint32_t t : around_[place])
        for (int k = 0; k < 3 && !dead_[t]; ++k) {
            const std::uint32_t other = wedges_.places[triangles_[t][k]];
            if (other != place && !holds(result, other)) result.push_back(other);
        }
    return result;
}

/// Each wedge of `from` has to be joined by an edge to exactly one wedge of `to`, no two to the same.
bool Simplifier::findTargets(std::uint32_t from, std::uint32_t to, Targets& targets) const {
    targets.clear();
    for (std::uint32_t t : around_[from]) {
        if (dead_[t]) continue;
        const std::uint32_t wedge = cornerAt(t, from), target = cornerAt(t, to);
        auto known = std::ranges::find(targets, wedge, &Targets::value_type::first);
        if (known == targets.end()) known = targets.insert(targets.end(), {wedge, none});
        if (target == none || known->second == target) continue;
        if (known->second != none || std::ranges::find(targets, target, &Targets::value_type::second) != targets.end()) return false;
        known->second = target;
    }
    return std::ranges::none_of(targets, [](const auto& pair) { return pair.second == none; });
}

/// The edge's ends may share no neighbour but the far corners of its triangles (the link condition), a place of the open border may only
/// go along it, and something has to be left.
bool Simplifier::keepsTopology(std::uint32_t from, std::uint32_t to) const {
    std::size_t shared = 0, left = 0;
    std::vector<std::uint32_t> once;  // neighbours of `from` met an odd number of times: the border goes on there
    for (std::uint32_t t : around_[from]) {
        if (dead_[t]) continue;
        if (cornerAt(t, to) != none)
            ++shared;
        else
            ++left;
        for (int k = 0; k < 3; ++k) {
            const std::uint32_t other = wedges_.places[triangles_[t][k]];
            if (other == from) continue;
            if (const auto found = std::ranges::find(once, other); found != once.end())
                once.erase(found);
            else
                once.push_back(other);
        }
    }
    for (std::uint32_t t : around_[to]) left += !dead_[t] && cornerAt(t, from) == none;
    if (left == 0 || (!once.empty() && !holds(once, to))) return false;
    const std::vector<std::uint32_t> others = neighbours(to);
    const auto common = std::ranges::count_if(neighbours(from), [&](std::uint32_t n) { return holds(others, n); });
    return std::size_t(common) == shared;
}

bool Simplifier::turnsOver(std::uint32_t from, std::uint32_t to, const Targets& targets) const {
    for (std::uint32_t t : around_[from]) {
        if (dead_[t] || cornerAt(t, to) != none) continue;
        const glm::uvec3 before = triangles_[t];
        glm::uvec3 after = before;
        for (int k = 0; k < 3; ++k)
            for (const auto& [wedge, target] : targets)
                if (before[k] == wedge) after[k] = target;
        const auto normal = [&](const glm::uvec3& w) {
            const glm::dvec3 a(wedges_.positions[w.x]);
            return glm::cross(glm::dvec3(wedges_.positions[w.y]) - a, glm::dvec3(wedges_.positions[w.z]) - a);
        };
        const glm::dvec3 n = normal(before), m = normal(after);
        if (!(glm::dot(n, m) > mostTurn * glm::length(n) * glm::length(m)) && n != glm::dvec3(0)) return true;
        const auto area = [&](const glm::uvec3& w) { return uvArea(wedges_.uvs[w.x], wedges_.uvs[w.y], wedges_.uvs[w.z]); };
        const double old = area(before);
        if (old != 0 && !(area(after) * old > 0)) return true;
    }
    return false;
}

bool Simplifier::isAllowed(std::uint32_t from, std::uint32_t to, Targets& targets) const {
    return findTargets(from, to, targets) && keepsTopology(from, to) && !turnsOver(from, to, targets);
}

/// Finds the cheapest way for a place to go, if there is one.
void Simplifier::plan(std::uint32_t place) {
    ++ages_[place];
    if (held_[place]) return;
    // What is allowed costs more to know than what a way costs: the cheapest are asked first.
    std::vector<std::pair<double, std::uint32_t>> ways;
    Targets targets;
    for (std::uint32_t to : neighbours(place)) {
        if (!findTargets(place, to, targets)) continue;
        double cost = 0, way = 0;
        for (const auto& [wedge, target] : targets) {
            Quadric sum = quadrics_[wedge];
            sum += quadrics_[target];
            cost += sum.at(points_[target]) + attributeCost(wedge, target);
            for (std::size_t i = 0; i < 3; ++i) way += (points_[wedge][i] - points_[target][i]) * (points_[wedge][i] - points_[target][i]);
        }
        cost += shortnessWeight * way * way;
        if (std::isfinite(cost)) ways.emplace_back(cost, to);
    }
    std::ranges::stable_sort(ways, {}, &std::pair<double, std::uint32_t>::first);
    for (const auto& [cost, to] : ways) {
        if (!isAllowed(place, to, targets)) continue;
        steps_.push({cost, place, to, ages_[place]});
        return;
    }
}

void Simplifier::collapse(const Step& step, const Targets& targets) {
    for (const auto& [wedge, target] : targets) {
        quadrics_[target] += quadrics_[wedge];
        attributes_.add(target, wedge);
    }
    for (std::uint32_t t : around_[step.from]) {
        if (dead_[t]) continue;
        if (cornerAt(t, step.to) != none) {
            dead_[t] = true;
            --alive_;
            continue;
        }
        for (int k = 0; k < 3; ++k)
            for (const auto& [wedge, target] : targets)
                if (triangles_[t][k] == wedge) {
                    triangles_[t][k] = target;
                    break;
                }
        around_[step.to].push_back(t);
    }
    around_[step.from].clear();
    ++ages_[step.from];
    std::erase_if(around_[step.to], [&](std::uint32_t t) { return dead_[t]; });
    for (std::uint32_t other : neighbours(step.to)) {
        std::erase_if(around_[other], [&](std::uint32_t t) { return dead_[t]; });
        plan(other);
    }
    plan(step.to);
}

void Simplifier::reduce(std::size_t triangles) {
    Targets targets;
    while (alive_ > triangles && !steps_.empty()) {
        const Step step = steps_.top();
        steps_.pop();
        if (step.age != ages_[step.from]) continue;
        if (isAllowed(step.from, step.to, targets))
            collapse(step, targets);
        else
            plan(step.from);  // something changed farther away than its neighbours
    }
}

Simplified Simplifier::result() const {
    Simplified simplified;
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
        if (dead_[t]) continue;
        const glm::uvec3 w = triangles_[t];
        const glm::vec3 face = glm::cross(wedges_.positions[w.y] - wedges_.positions[w.x], wedges_.positions[w.z] - wedges_.positions[w.x]);
        // Of the vertices that differ only in their normals, the one that suits the face.
        const auto vertex = [&](std::uint32_t wedge) {
            const std::vector<std::uint32_t>& all = wedges_.vertices[wedge];
            if (surface_.normals.empty()) return all.front();
            return *std::ranges::max_element(all, {}, [&](std::uint32_t v) { return glm::dot(surface_.normals[v], face); });
        };
        simplified.triangles.emplace_back(vertex(w.x), vertex(w.y), vertex(w.z));
        simplified.groups.push_back(wedges_.groups[w.x]);
    }
    return simplified;
}

}  // namespace lodestir
