// SPDX-License-Identifier: MIT
// tau on whole models: vertices that pass from level to level by their texture coordinates.
//
// Where each row of the test matrix is asked ("points": here, passes/lod/vertex_mapping_check all over a mesh; "images": reuse across the switch,
// level_switch_test.cpp; "by hand": passes/lod/vertex_mapping.test.comp, on squares):
//   identity                    points Identity, images Identity; by hand
//   round trip                  points Meshes (every pair of levels of rock, plane, cube and all chess pieces); by hand
//   area conservation           points Meshes
//   finite difference           points Meshes
//   mirrored halves             points Plane; by hand
//   one chart for six faces     points Cube
//   unequal counts              points UnequalCounts, images; by hand
//   seam moved between levels   points MovedSeam, images
//   degenerate UV triangles     points Degenerate, images; by hand
//   UV outside [0,1], negative  points Tiled
//   repeats wrapped to [0,1]    points Wrapped
//   more than 8 overlaps        by hand
//   no or inconsistent UVs      points WithoutCoordinates, images
//   several instances           images OneOfTwoInstances
//   animated instance + switch  images (moving)
//   emissive mesh               images EmitterStaysAtItsFinest, images (lamp)
//   switch every frame          images (flicker), images ReusePays
//   self-occluding              images SelfOccluding, images (hidden)
//   different normals           images ReusePays
#include "sheets.h"
#include "shift_session.h"

#include <passes/lod/vertex_mapping_check/vertex_mapping_check.h>

#include <set>

namespace lodestir::test {
namespace {

/// Maps points of meshes, a fresh set at each call.
class Points {
public:
    Points(const Path& scene, glm::uvec2 size)
        : frames_(scene, size, {{"uv", {{"type", "lod_uv_bvh_build"}}}, {"map", node("vertex_mapping_check", {{"uv", "uv"}})}}, {"map.checks"}) {}

    const Scene& scene() const { return frames_.scene(); }
    std::vector<MappingCheck> map(std::size_t instance, int from, int to, bool matching = true) {
        frames_.set("map.instance", Json(int(instance)));
        frames_.set("map.from", Json(from));
        frames_.set("map.to", Json(to));
        frames_.set("map.matching", Json(matching));
        frames_.run();
        return frames_.records<MappingCheck>("map.checks");
    }
    std::size_t instanceOf(const std::string& mesh) const {
        for (std::size_t i = 0; i < scene().instances.size(); ++i)
            if (scene().meshes[scene().instances[i].mesh].name == mesh) return i;
        ADD_FAILURE() << "no mesh " << mesh;
        return 0;
    }

private:
    Frames frames_;
};

bool has(const MappingCheck& p, std::uint32_t bit) { return (p.outcome & bit) != 0; }

/// Below this thickness a place is known to no better than a thousandth of its triangle, and what is asked of places is not asked.
constexpr float thin = 1e3f;

struct Summary {
    std::size_t points = 0, held = 0, there = 0, same = 0, passed = 0, differences = 0;
    std::size_t notHeld = 0;  ///< by their own triangle, without being on its edge or one of too many
    std::size_t thinOnes = 0;
    double worstReturn = 0, worstJacobian = 0, worstDifference = 0;  ///< of triangles that are not thin
    Mean area;   ///< of what is mapped, on the level it comes from
    Mean image;  ///< of the same on the other level
    Mean whole;  ///< of the level

    double share() const { return area.value / whole.value; }
};

Summary summaryOf(const std::vector<MappingCheck>& points) {
    Summary s;
    std::vector<double> area, image, whole;
    for (const MappingCheck& p : points) {
        EXPECT_TRUE(has(p, MAPPING_TRIED));
        for (const float v : {p.area, p.stretch, p.errorJacobian, p.errorReturn, p.finiteDifference, p.image.x, p.image.y, p.image.z})
            EXPECT_TRUE(std::isfinite(v));
        ++s.points;
        s.held += has(p, MAPPING_HELD);
        s.notHeld += !has(p, MAPPING_HELD) && p.here > 0 && p.edge * p.thickness > 4;
        s.there += has(p, MAPPING_THERE);
        s.same += has(p, MAPPING_BACK) && has(p, MAPPING_SAME);
        s.passed += has(p, MAPPING_PASSED);
        whole.push_back(p.area);
        area.push_back(has(p, MAPPING_THERE) ? p.area : 0);
        image.push_back(has(p, MAPPING_THERE) ? p.area * p.stretch : 0);
        s.worstJacobian = std::max(s.worstJacobian, double(p.errorJacobian));
        s.thinOnes += has(p, MAPPING_THERE) && p.thickness < thin;
        if (p.thickness < thin) continue;
        s.worstReturn = std::max(s.worstReturn, double(p.errorReturn));
        // Finite differences take a tenth of a triangle.
        if (p.finiteDifference == 0 || p.thickness < 10 * thin) continue;
        ++s.differences;
        s.worstDifference = std::max(s.worstDifference, std::abs(double(p.finiteDifference) / p.stretch - 1));
    }
    s.area = meanOf(area);
    s.image = meanOf(image);
    s.whole = meanOf(whole);
    return s;
}

void print(const std::string& name, const Summary& s) {
    std::printf(
        "%-18s mapped %.5f of the area, %zu of %zu points, %zu lost on the way back; return <= %.1e, |JJ'-1| <= %.1e, differences %zu <= %.1e; %zu past a "
        "nearer one, %zu thin\n",
        name.c_str(), s.share(), s.there, s.points, s.there - s.same, s.worstReturn, s.worstJacobian, s.differences, s.worstDifference, s.passed, s.thinOnes);
}

/// All that must hold of any mesh; `least`: share of its area that is mapped.
void expectSound(const std::string& name, const Summary& s, double least) {
    print(name, s);
    EXPECT_EQ(s.same, s.there) << name << ": points that don't come back";
    EXPECT_EQ(s.notHeld, 0u) << name;
    EXPECT_GE(s.share(), least) << name;
    EXPECT_LT(s.worstReturn, 1e-4) << name;
    EXPECT_LT(s.worstJacobian, 1e-5) << name;
    EXPECT_LT(s.worstDifference, 0.01) << name;
    EXPECT_LT(double(s.thinOnes), 0.002 * double(s.points)) << name;
}

/// What is mapped from either level has as much area on the other one as is mapped from there.
void expectAreaKept(const std::string& name, const Summary& there, const Summary& back) {
    const auto expectSame = [&](const Mean& pushed, const Mean& sampled) {
        const double sigma = std::sqrt(pushed.variance + sampled.variance);
        EXPECT_LT(std::abs(pushed.value - sampled.value), 4 * sigma + 1e-5 * sampled.value) << name;
        EXPECT_LT(sigma, 0.05 * sampled.value) << name << ": inconclusive";
    };
    expectSame(there.image, back.area);
    expectSame(back.image, there.area);
}

struct Model {
    const char* scene;
    double least;         ///< share of the area that is mapped between any two levels
    std::uint32_t width;  ///< points are its square
};
void PrintTo(const Model& m, std::ostream* out) { *out << m.scene; }
class Meshes : public testing::TestWithParam<Model> {};

TEST_P(Meshes, ComeBackAndKeepTheirArea) {
    Points points(sceneFile(GetParam().scene), glm::uvec2(GetParam().width));
    std::set<std::uint32_t> seen;
    for (std::size_t i = 0; i < points.scene().instances.size(); ++i) {
        const std::uint32_t index = points.scene().instances[i].mesh;
        const Mesh& mesh = points.scene().meshes[index];
        if (mesh.levels.size() < 2 || !seen.insert(index).second) continue;
        for (int a = 0; a < int(mesh.levels.size()); ++a) {
            for (int b = a + 1; b < int(mesh.levels.size()); ++b) {
                const std::string name = mesh.name + " " + std::to_string(a) + ">" + std::to_string(b),
                                  inverse = mesh.name + " " + std::to_string(b) + ">" + std::to_string(a);
                const Summary there = summaryOf(points.map(i, a, b)), back = summaryOf(points.map(i, b, a));
                expectSound(name, there, GetParam().least);
                expectSound(inverse, back, GetParam().least);
                expectAreaKept(name, there, back);
                EXPECT_GT(there.differences + back.differences, 100u) << name;
            }
        }
    }
    EXPECT_FALSE(seen.empty());
}

// Where the chessboard loses two hundredths: more than eight parts of the kings' crosses share a coordinate.
INSTANTIATE_TEST_SUITE_P(, Meshes, testing::Values(Model{"rock", 0.999, 96}, Model{"plane", 0.998, 96}, Model{"cube", 0.999, 48},
                                         Model{"chessboard", 0.98, 48}),
                         [](const auto& model) { return std::string(model.param.scene); });

// Both halves of the aeroplane wear one half of a picture; it is x that tells them apart.
TEST(Plane, LeftStaysLeft) {
    Points points(sceneFile("plane"), {128, 128});
    const std::size_t plane = points.instanceOf("plane");
    std::size_t crossed = 0, sided = 0;
    for (const MappingCheck& p : points.map(plane, 0, 1)) {
        if (!has(p, MAPPING_THERE)) continue;
        if (std::abs(p.position.x) < 0.005) continue;  // twice the level's error
        ++sided;
        crossed += p.position.x * p.image.x < 0;
    }
    EXPECT_EQ(crossed, 0u);
    EXPECT_GT(sided, 10'000u);
    std::size_t shared = 0, mapped = 0;
    for (const MappingCheck& p : points.map(plane, 0, 1, false)) {
        mapped += has(p, MAPPING_THERE);
        shared += p.here > 1 || p.there > 1;
        EXPECT_FALSE(has(p, MAPPING_THERE) && (p.here != 1 || p.there != 1));
    }
    std::printf("plane: %zu points with a side; without matching %zu mapped, %zu share their coordinate\n", sided, mapped, shared);
    EXPECT_GT(shared, 16'000u);
    EXPECT_EQ(mapped, 0u);
}

// One chart for six faces: only the nearest of six points is the right one.
TEST(Cube, EachFaceStaysItself) {
    Points points(sceneFile("cube"), {64, 64});
    const std::size_t cube = points.instanceOf("cube");
    std::size_t six = 0, other = 0, clear = 0, passed = 0;
    const auto faceOf = [](glm::vec3 p) {
        const glm::vec3 a = glm::abs(p);
        const int axis = a.x > a.y && a.x > a.z ? 0 : a.y > a.z ? 1 : 2;
        return 2 * axis + (p[axis] < 0 ? 1 : 0);
    };
    glm::vec3 low(1e30f), high(-1e30f);
    const std::vector<MappingCheck> mapped = points.map(cube, 0, 1);
    for (const MappingCheck& p : mapped) {
        low = glm::min(low, p.position);
        high = glm::max(high, p.position);
    }
    for (const MappingCheck& p : mapped) {
        six += p.here == 6 && p.there == 6;
        passed += has(p, MAPPING_PASSED);
        if (!has(p, MAPPING_THERE)) continue;
        const glm::vec3 from = (2.0f * p.position - low - high) / (high - low), to = (2.0f * p.image - low - high) / (high - low);
        const glm::vec3 a = glm::abs(from);
        const float first = std::max({a.x, a.y, a.z}), second = a.x + a.y + a.z - first - std::min({a.x, a.y, a.z});
        if (first - second < 0.1f) continue;  // on the rounded edges faces meet
        ++clear;
        other += faceOf(from) != faceOf(to);
    }
    std::printf("cube: %zu of %zu points with six on both levels, %zu on a face, %zu of them to another, %zu past a nearer one\n", six, mapped.size(), clear,
                other, passed);
    EXPECT_GT(six, mapped.size() * 99 / 100);
    EXPECT_GT(clear, mapped.size() / 2);
    EXPECT_EQ(other, 0u);
    EXPECT_EQ(passed, 0u);
    for (const MappingCheck& p : points.map(cube, 0, 1, false)) EXPECT_FALSE(has(p, MAPPING_THERE));
}

class PointsOfSheets : public Sheets {
protected:
    std::vector<MappingCheck> map(const std::vector<SheetLevel>& levels, int from, int to, glm::uvec2 size = {64, 64}) {
        Points points(write("points", levels, switchAt(1)), size);
        return points.map(0, from, to);
    }
};

TEST_F(PointsOfSheets, Identity) {
    const auto points = map({{.cells = 8, .place = flat}, {.cells = 8, .place = flat, .otherDiagonal = true}, {.cells = 12, .place = flat}}, 0, 1);
    const Summary s = summaryOf(points);
    expectSound("identity", s, 0.999);
    for (const MappingCheck& p : points) {
        if (!has(p, MAPPING_THERE)) continue;
        ASSERT_LT(glm::distance(p.position, p.image), 1e-5f);
        ASSERT_NEAR(p.stretch, 1, 1e-4);
    }
}

TEST_F(PointsOfSheets, UnequalCounts) {
    // Both halves of level 0 have the same coordinates; level 1 has the right one alone, so that the left one is lost.
    const auto doubled = [](const SheetPoint& p) { return std::optional(glm::dvec2(p.at.x - (p.cell.x > 0.5 ? 0.5 : 0), p.at.y)); };
    const std::vector<SheetLevel> levels{{.cells = 8, .place = flat, .uv = doubled},
                                         {.cells = 4, .place = flat, .uv = doubled, .has = [](glm::dvec2 cell) { return cell.x > 0.5; }}};
    for (const MappingCheck& p : map(levels, 0, 1)) {
        EXPECT_TRUE(!has(p, MAPPING_HELD) || has(p, MAPPING_THERE) == (p.position.x > 0)) << p.position.x << " " << p.edge;
        EXPECT_TRUE(!has(p, MAPPING_THERE) || glm::distance(p.position, p.image) < 1e-5f);
    }
    const Summary back = summaryOf(map(levels, 1, 0));
    expectSound("from the half", back, 0.999);
}

TEST_F(PointsOfSheets, MovedSeam) {
    // The chart is cut at x = 1/2 on level 0 and at 3/8 on level 1; its right part lies 1/5 farther on.
    const auto cut = [](double at) {
        return [at](const SheetPoint& p) { return std::optional(glm::dvec2(p.at.x + (p.cell.x > at ? 0.2 : 0), p.at.y)); };
    };
    const std::vector<SheetLevel> levels{{.cells = 16, .place = flat, .uv = cut(0.5)}, {.cells = 8, .place = flat, .uv = cut(0.375)}};
    for (const int from : {0, 1}) {
        const auto points = map(levels, from, 1 - from, {128, 128});
        const Summary s = summaryOf(points);
        expectSound("moved seam", s, 0.85);
        const double sigma = std::sqrt(s.area.variance);
        EXPECT_NEAR(s.area.value, 4 * 0.875, 4 * sigma);
        EXPECT_LT(sigma, 0.02);
        for (const MappingCheck& p : points) {
            const bool gap = p.position.x > -0.25f && p.position.x < 0;
            if (has(p, MAPPING_HELD) && std::abs(p.position.x + 0.25f) > 1e-5f && std::abs(p.position.x) > 1e-5f) {
                EXPECT_EQ(has(p, MAPPING_THERE), !gap) << p.position.x;
            }
            if (has(p, MAPPING_THERE)) {
                EXPECT_LT(glm::distance(p.position, p.image), 1e-5f);
            }
        }
    }
}

TEST_F(PointsOfSheets, Degenerate) {
    const std::vector<SheetLevel> levels{{.cells = 9, .place = flat, .uv = pinched}, {.cells = 18, .place = flat}};
    for (const int from : {0, 1}) {
        const auto points = map(levels, from, 1 - from);
        const Summary s = summaryOf(points);
        expectSound("degenerate", s, 0.6);
        for (const MappingCheck& p : points) {
            const float row = 4.5f * (p.position.z + 1);
            if (std::abs(row - std::round(row)) > 1e-4f && has(p, MAPPING_HELD)) {
                EXPECT_EQ(has(p, MAPPING_THERE), int(row) % 3 != 1) << row;
            }
        }
        EXPECT_NEAR(s.share(), 2.0 / 3, 0.04);
    }
}

TEST_F(PointsOfSheets, Tiled) {
    // Five repeats from -2.3 on, side by side in the plane of UV: no point is taken for one of another repeat.
    const auto tiled = [](const SheetPoint& p) { return std::optional(5.0 * p.at - 2.3); };
    const auto points = map({{.cells = 20, .place = bowl, .uv = tiled}, {.cells = 7, .place = bowl, .uv = tiled}}, 0, 1);
    const Summary s = summaryOf(points);
    expectSound("tiled", s, 0.999);
    EXPECT_EQ(s.passed, 0u);
    for (const MappingCheck& p : points) {
        EXPECT_LE(p.there, 2u);  // two on an edge
        if (has(p, MAPPING_THERE)) {
            EXPECT_LT(glm::length(glm::vec2(p.image.x - p.position.x, p.image.z - p.position.z)), 1e-4f);
        }
    }
}

TEST_F(PointsOfSheets, Wrapped) {
    // The same coordinates in four quarters: four points of each, told apart by place.
    const auto wrapped = [](const SheetPoint& p) { return std::optional(2.0 * p.at - glm::dvec2(p.cell.x > 0.5, p.cell.y > 0.5)); };
    const std::vector<SheetLevel> levels{{.cells = 20, .place = bowl, .uv = wrapped}, {.cells = 6, .place = bowl, .uv = wrapped}};
    for (const int from : {0, 1}) {
        const auto points = map(levels, from, 1 - from);
        const Summary s = summaryOf(points);
        expectSound("wrapped", s, 0.999);
        std::size_t four = 0;
        for (const MappingCheck& p : points) {
            four += p.here == 4 && p.there == 4;
            if (has(p, MAPPING_THERE)) {
                EXPECT_LT(glm::length(glm::vec2(p.image.x - p.position.x, p.image.z - p.position.z)), 1e-4f);
            }
        }
        EXPECT_GT(four, points.size() * 95 / 100);
    }
}

TEST_F(PointsOfSheets, WithoutCoordinates) {
    const auto nothing = [](const SheetPoint&) { return std::optional<glm::dvec2>(); };
    const std::vector<SheetLevel> without{{.cells = 8, .place = bowl, .uv = nothing}, {.cells = 4, .place = bowl, .uv = nothing}};
    const std::vector<SheetLevel> half{{.cells = 8, .place = bowl}, {.cells = 4, .place = bowl, .uv = nothing}};
    for (const auto& levels : {without, half}) {
        for (const int from : {0, 1}) {
            const Summary s = summaryOf(map(levels, from, 1 - from));
            EXPECT_EQ(s.there, 0u);
        }
    }
}

}  // namespace
}  // namespace lodestir::test
