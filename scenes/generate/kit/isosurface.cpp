// SPDX-License-Identifier: MIT
// Triangles of an implicit surface: see isosurface.h.
#include "isosurface.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <bitset>
#include <cmath>
#include <thread>
#include <unordered_map>

namespace lodestir::generate {

namespace {

constexpr int side = 8;           // cells of a brick
constexpr int corners = side + 1;
constexpr uint32_t nothing = ~0u;

/// Cells that the surface may cross.
struct Brick {
    glm::ivec3 first;                                      // its least cell
    std::bitset<size_t(corners * corners * corners)> inside;
    std::vector<std::pair<uint16_t, glm::vec3>> crossed;   // cell and vertex
    std::array<uint32_t, size_t(side * side * side)> number;  // of the vertex of each cell
};

int cornerIndex(const glm::ivec3& c) { return c.x + corners * (c.y + corners * c.z); }
int cellIndex(const glm::ivec3& c) { return c.x + side * (c.y + side * c.z); }

uint64_t keyOf(const glm::ivec3& brick) {
    return (uint64_t(uint32_t(brick.x)) & 0x1fffff) | (uint64_t(uint32_t(brick.y)) & 0x1fffff) << 21 | (uint64_t(uint32_t(brick.z)) & 0x1fffff) << 42;
}

/// Calls work(i) for all of them, on all cores.
template <class Work> void forAll(size_t count, const Work& work) {
    std::atomic<size_t> next{0};
    const auto take = [&] {
        for (size_t i = next++; i < count; i = next++) work(i);
    };
    std::vector<std::jthread> threads;
    for (unsigned i = 1; i < std::thread::hardware_concurrency(); ++i) threads.emplace_back(take);
    take();
}

class Net {
public:
    Net(const Distance& of, const glm::vec3& from, const glm::vec3& to, float cell) : distance(of), low(from), step(cell) {
        const glm::vec3 size = to - from;
        int cells = side;
        while (float(cells) * step < std::max({size.x, size.y, size.z})) cells *= 2;
        descend({0, 0, 0}, cells);
        forAll(bricks.size(), [&](size_t i) { sample(bricks[i]); });
        std::erase_if(bricks, [](const Brick& brick) { return brick.crossed.empty(); });
    }

    Mesh mesh() {
        Mesh mesh;
        std::unordered_map<uint64_t, size_t> places;
        for (size_t i = 0; i < bricks.size(); ++i) {
            Brick& brick = bricks[i];
            places[keyOf(brick.first / side)] = i;
            brick.number.fill(nothing);
            for (const auto& [cell, position] : brick.crossed) brick.number[cell] = mesh.add({.position = position, .normal = glm::vec3(0)});
        }
        const auto numberOf = [&](const Brick& brick, const glm::ivec3& cell) {
            if (glm::all(glm::greaterThanEqual(cell, glm::ivec3(0)))) return brick.number[size_t(cellIndex(cell))];
            const glm::ivec3 whole = brick.first + cell;
            const auto found = places.find(keyOf(whole / side));
            return found == places.end() ? nothing : bricks[found->second].number[size_t(cellIndex(whole % side))];
        };
        for (const Brick& brick : bricks)
            for (const auto& [cell, position] : brick.crossed) addQuads(mesh, brick, {cell % side, cell / side % side, cell / side / side}, numberOf);
        addNormals(mesh);
        return mesh;
    }

private:
    glm::vec3 at(const glm::ivec3& corner) const { return low + step * glm::vec3(corner); }

    void descend(const glm::ivec3& first, int cells) {
        const float half = 0.5f * float(cells) * step;
        if (std::abs(distance(at(first) + half)) > 1.7320508f * half) return;
        if (cells == side) {
            bricks.push_back({.first = first, .inside = {}, .crossed = {}, .number = {}});
            return;
        }
        for (int child = 0; child < 8; ++child) descend(first + cells / 2 * glm::ivec3(child & 1, child >> 1 & 1, child >> 2), cells / 2);
    }

    void sample(Brick& brick) const {
        std::array<float, size_t(corners * corners * corners)> values;
        for (int z = 0; z < corners; ++z)
            for (int y = 0; y < corners; ++y)
                for (int x = 0; x < corners; ++x) {
                    const size_t i = size_t(cornerIndex({x, y, z}));
                    values[i] = distance(at(brick.first + glm::ivec3(x, y, z)));
                    brick.inside[i] = values[i] < 0;
                }
        for (int cell = 0; cell < side * side * side; ++cell) {
            const glm::ivec3 c(cell % side, cell / side % side, cell / side / side);
            glm::vec3 sum(0);
            int count = 0;
            for (int axis = 0; axis < 3; ++axis)
                for (int edge = 0; edge < 4; ++edge) {
                    glm::ivec3 a = c, b;
                    a[(axis + 1) % 3] += edge & 1, a[(axis + 2) % 3] += edge >> 1;
                    b = a, ++b[axis];
                    const float from = values[size_t(cornerIndex(a))], to = values[size_t(cornerIndex(b))];
                    if ((from < 0) == (to < 0)) continue;
                    sum += at(brick.first + a);
                    sum[axis] += step * from / (from - to);
                    ++count;
                }
            if (count > 0) brick.crossed.emplace_back(uint16_t(cell), sum / float(count));
        }
    }

    /// Around the edges that leave the least corner of a cell.
    template <class NumberOf> void addQuads(Mesh& mesh, const Brick& brick, const glm::ivec3& cell, const NumberOf& numberOf) const {
        const bool inside = brick.inside[size_t(cornerIndex(cell))];
        for (int axis = 0; axis < 3; ++axis) {
            glm::ivec3 along(0), u(0), v(0);
            along[axis] = u[(axis + 1) % 3] = v[(axis + 2) % 3] = 1;
            if (brick.inside[size_t(cornerIndex(cell + along))] == inside) continue;
            std::array<uint32_t, 4> ring{numberOf(brick, cell - u - v), numberOf(brick, cell - v), numberOf(brick, cell), numberOf(brick, cell - u)};
            if (std::ranges::count(ring, nothing) > 0) continue;  // the box cuts the surface
            if (!inside) std::swap(ring[1], ring[3]);
            // Along the shorter diagonal, which follows creases.
            const auto length = [&](int a, int b) { return glm::distance(mesh.vertices[ring[size_t(a)]].position, mesh.vertices[ring[size_t(b)]].position); };
            if (length(1, 3) < length(0, 2)) std::rotate(ring.begin(), ring.begin() + 1, ring.end());
            mesh.quad(ring[0], ring[1], ring[2], ring[3]);
        }
    }

    /// The mean of the faces around, by their area.
    static void addNormals(Mesh& mesh) {
        for (size_t i = 0; i < mesh.indices.size(); i += 3) {
            Vertex &a = mesh.vertices[mesh.indices[i]], &b = mesh.vertices[mesh.indices[i + 1]], &c = mesh.vertices[mesh.indices[i + 2]];
            const glm::vec3 face = glm::cross(b.position - a.position, c.position - a.position);
            for (Vertex* v : {&a, &b, &c}) v->normal += face;
        }
        for (Vertex& v : mesh.vertices) v.normal = glm::dot(v.normal, v.normal) > 0 ? glm::normalize(v.normal) : glm::vec3(0, 1, 0);
    }

    const Distance& distance;
    glm::vec3 low;
    float step;
    std::vector<Brick> bricks;
};

}  // namespace

Mesh isosurface(const Distance& distance, const glm::vec3& low, const glm::vec3& high, float step) { return Net(distance, low, high, step).mesh(); }

}  // namespace lodestir::generate
