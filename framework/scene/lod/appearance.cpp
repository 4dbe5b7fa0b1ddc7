// SPDX-License-Identifier: MIT
#include <framework/scene/lod/appearance.h>

#include <framework/scene/lod/wedges.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace lodestir {
namespace {

constexpr double colorShare = 1.0 / 32, frameShare = 1.0 / 3000;  ///< of the diagonal, see the header

template <class V> bool isFinite(const V& v) {
    for (int i = 0; i < V::length(); ++i)
        if (!std::isfinite(v[i])) return false;
    return true;
}

glm::vec3 direction(const glm::vec3& v) {
    const float length = glm::length(v);
    return std::isfinite(length) && length > 0 ? v / length : glm::vec3(0);
}

template <class Visit> void forFiniteTriangles(const MeshLevel& level, const Visit& visit) {
    for (const glm::uvec3& t : level.triangles)
        if (isFinite(level.positions[t.x]) && isFinite(level.positions[t.y]) && isFinite(level.positions[t.z])) visit(t);
}

}  // namespace

Box boundsOfTriangles(const MeshLevel& level) {
    Box box;
    forFiniteTriangles(level, [&](const glm::uvec3& t) {
        for (int k = 0; k < 3; ++k) box.add(level.positions[t[k]]);
    });
    return box;
}

double uvLength(const MeshLevel& level, const std::vector<glm::vec2>& uvs) {
    if (uvs.empty()) return 0;
    double area = 0, chartArea = 0;
    forFiniteTriangles(level, [&](const glm::uvec3& t) {
        const glm::dvec3 a(level.positions[t.x]);
        area += glm::length(glm::cross(glm::dvec3(level.positions[t.y]) - a, glm::dvec3(level.positions[t.z]) - a));
        chartArea += std::abs(uvArea(uvs[t.x], uvs[t.y], uvs[t.z]));
    });
    return chartArea > 0 && std::isfinite(chartArea) ? std::sqrt(area / chartArea) : 0;
}

Appearance::Appearance(const MeshLevel& level, unsigned parts) {
    const Box box = boundsOfTriangles(level);
    const double diagonal = box.isEmpty() ? 0 : glm::length(glm::dvec3(box.high) - glm::dvec3(box.low));
    frameLength_ = float(frameShare * diagonal);
    colorLength_ = float(colorShare * diagonal);
    const bool normals = (parts & frames) != 0 && !level.normals.empty(), tangents = (parts & frames) != 0 && !level.tangents.empty();
    const std::array chosen{(parts & uv0) != 0 && !level.uv0.empty(), (parts & uv1) != 0 && !level.uv1.empty()};
    const bool painted = (parts & colors) != 0 && !level.colors.empty();
    frameSize_ = 3 * (std::size_t(normals) + std::size_t(tangents));
    colorPlace_ = frameSize_ + 2 * (std::size_t(chosen[0]) + std::size_t(chosen[1]));
    size_ = colorPlace_ + (painted ? 4 : 0);
    values_.reserve(level.positions.size() * size_);
    const std::array uvs{&level.uv0, &level.uv1};
    const std::array lengths{chosen[0] ? float(uvLength(level, level.uv0)) : 0, chosen[1] ? float(uvLength(level, level.uv1)) : 0};
    const auto put = [&](const auto& v, float length) {
        for (int i = 0; i < v.length(); ++i) values_.push_back(length * v[i]);
    };
    for (std::size_t v = 0; v < level.positions.size(); ++v) {
        if (normals) put(direction(level.normals[v]), frameLength_);
        if (tangents) put(direction(glm::vec3(level.tangents[v])), frameLength_);
        for (std::size_t set = 0; set < 2; ++set)
            if (chosen[set]) put(isFinite((*uvs[set])[v]) ? (*uvs[set])[v] : glm::vec2(0), lengths[set]);
        if (painted) put(level.colors[v], colorLength_);
    }
}

void Appearance::paint(const std::vector<glm::vec4>& values) {
    for (std::size_t v = 0; v < values.size(); ++v)
        for (int i = 0; i < 4; ++i) values_[v * size_ + colorPlace_ + std::size_t(i)] = colorLength_ * values[v][i];
}

void Appearance::turn(const std::vector<glm::vec3>& values) {
    for (std::size_t v = 0; v < values.size(); ++v)
        for (int i = 0; i < 3; ++i) values_[v * size_ + std::size_t(i)] = frameLength_ * direction(values[v])[i];
}

/// By the region of the plane that the point projects to (Ericson 2005, section 5.1.5), which needs nothing but products of vectors and so
/// holds in any number of dimensions.
NearestPoint nearestOn(const glm::uvec3& triangle, const std::vector<glm::vec3>& positions, const Appearance& appearance,
                       const glm::dvec3& position, std::span<const double> looks) {
    double ee = 0, ef = 0, ff = 0, ep = 0, fp = 0, pp = 0;
    const auto add = [&](double a, double b, double c, double p) {
        const double e = b - a, f = c - a, q = p - a;
        ee += e * e, ef += e * f, ff += f * f, ep += e * q, fp += f * q, pp += q * q;
    };
    const glm::dvec3 a(positions[triangle.x]), b(positions[triangle.y]), c(positions[triangle.z]);
    for (int i = 0; i < 3; ++i) add(a[i], b[i], c[i], position[i]);
    const auto x = appearance.of(triangle.x), y = appearance.of(triangle.y), z = appearance.of(triangle.z);
    for (std::size_t i = 0; i < looks.size(); ++i) add(x[i], y[i], z[i], looks[i]);

    NearestPoint best{.squaredDistance = std::numeric_limits<double>::infinity()};
    const auto offer = [&](double v, double w) {
        const double squared = std::max(pp - 2 * (v * ep + w * fp) + v * v * ee + 2 * v * w * ef + w * w * ff, 0.0);
        if (squared < best.squaredDistance) best = {.weights = {1 - v - w, v, w}, .squaredDistance = squared};
    };
    const double determinant = ee * ff - ef * ef;
    if (determinant > 0) {
        const double v = (ff * ep - ef * fp) / determinant, w = (ee * fp - ef * ep) / determinant;
        if (v >= 0 && w >= 0 && v + w <= 1) {
            offer(v, w);
            return best;
        }
    }
    const auto share = [](double along, double squaredLength) {
        return squaredLength > 0 ? std::clamp(along / squaredLength, 0.0, 1.0) : 0.0;
    };
    offer(share(ep, ee), 0);
    offer(0, share(fp, ff));
    const double t = share(fp - ep - ef + ee, ee - 2 * ef + ff);  // from b to c
    offer(1 - t, t);
    return best;
}

}  // namespace lodestir
