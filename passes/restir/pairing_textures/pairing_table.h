// SPDX-License-Identifier: MIT
// Pairs the pixels of a square at a distance that is close to normal (Lin et al. 2026, ReSTIR PT Enhanced, section 3): pixels that begin as neighbours
// carry the same link, and shuffling 2x2 blocks, whose grid alternates between two places, lets the links wander as if at random.
#pragma once
#include <glm/glm.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

namespace lodestir {

/// Standard deviation per axis of a normal distribution whose mean distance, sqrt(pi / 2) sigma, is that of a uniform disk, 2 R / 3.
inline double pairingSigma(double radius) { return std::sqrt(8 / (9 * std::numbers::pi)) * radius; }

/// A square whose edges meet, each pixel with a link that one other has too.
class PairingLinks {
public:
    PairingLinks(std::uint32_t size, std::uint64_t seed) : size_(size), state_(seed), links_(std::size_t(size) * size) {
        for (std::size_t i = 0; i < links_.size(); ++i) links_[i] = std::uint32_t(i / 2);
    }

    /// Permutes the links of `share` of the 2x2 blocks, each of the 24 ways as likely; the grid of odd passes lies a pixel further along both axes.
    void shuffle(std::uint32_t pass, double share) {
        const std::uint32_t first = pass % 2;
        const auto limit = std::uint64_t(share * 0x1p32);
        for (std::uint32_t y = first; y < size_ + first; y += 2) {
            std::uint32_t* const rows[2] = {&links_[std::size_t(y) * size_], &links_[std::size_t((y + 1) % size_) * size_]};
            for (std::uint32_t x = first; x < size_ + first; x += 2) {
                const std::uint64_t bits = random();
                if ((bits & 0xffffffff) >= limit) continue;
                const std::uint32_t right = (x + 1) % size_;
                std::uint32_t* const places[4] = {rows[0] + x, rows[0] + right, rows[1] + x, rows[1] + right};
                const std::uint32_t links[4] = {*places[0], *places[1], *places[2], *places[3]};
                const std::array<std::uint8_t, 4>& order = permutations()[std::size_t((bits >> 32) * 24 >> 32)];
                for (int i = 0; i < 4; ++i) *places[i] = links[order[i]];
            }
        }
    }

    /// From each pixel to the other with its link, the shortest way across the edges.
    std::vector<glm::ivec2> steps() const {
        constexpr std::uint32_t nobody = ~0u;
        std::vector<std::uint32_t> holders(links_.size() / 2, nobody);
        std::vector<glm::ivec2> steps(links_.size());
        const int size = int(size_), half = size / 2;
        for (std::uint32_t p = 0; p < links_.size(); ++p) {
            std::uint32_t& q = holders[links_[p]];
            if (q == nobody) {
                q = p;
                continue;
            }
            glm::ivec2 step(int(q % size_) - int(p % size_), int(q / size_) - int(p / size_));
            for (int axis = 0; axis < 2; ++axis) step[axis] += step[axis] > half ? -size : step[axis] < -half ? size : 0;
            steps[p] = step;
            steps[q] = -step;
        }
        return steps;
    }

private:
    /// SplitMix64 (Steele et al. 2014, Fast Splittable Pseudorandom Number Generators).
    std::uint64_t random() {
        std::uint64_t z = state_ += 0x9e3779b97f4a7c15;
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
        z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
        return z ^ (z >> 31);
    }
    static const std::array<std::array<std::uint8_t, 4>, 24>& permutations() {
        static const auto all = [] {
            std::array<std::array<std::uint8_t, 4>, 24> made;
            std::array<std::uint8_t, 4> order{0, 1, 2, 3};
            for (auto& one : made) {
                one = order;
                std::ranges::next_permutation(order);
            }
            return made;
        }();
        return all;
    }

    std::uint32_t size_;
    std::uint64_t state_;
    std::vector<std::uint32_t> links_;
};

/// Mean square of the steps per axis.
inline double variance(const std::vector<glm::ivec2>& steps) {
    std::int64_t sum = 0;
    for (const glm::ivec2 s : steps) sum += s.x * s.x + s.y * s.y;
    return double(sum) / 2 / double(steps.size());
}

/// Steps of `sigma` per axis, which is at least that of one pass of shuffling, sqrt(2/3), or becomes it. How many passes that takes is measured: about
/// sigma^2 / 2. Of the last one only as many blocks are shuffled as are missing.
inline std::vector<glm::ivec2> pairingSteps(std::uint32_t size, double sigma, std::uint64_t seed) {
    const double wanted = std::max(sigma * sigma, 2.0 / 3);
    PairingLinks links(size, seed);
    for (std::uint32_t pass = 0;; ++pass) {
        if (pass < 0.45 * wanted - 2) {
            links.shuffle(pass, 1);
            continue;
        }
        const double had = variance(links.steps());
        PairingLinks next = links;
        next.shuffle(pass, 1);
        const double has = variance(next.steps());
        if (has >= wanted) {
            links.shuffle(pass, (wanted - had) / (has - had));
            return links.steps();
        }
        links = std::move(next);
    }
}

}  // namespace lodestir
