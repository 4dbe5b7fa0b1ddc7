// SPDX-License-Identifier: MIT
// tau on whole models, and what it does to images: vertices that pass from level to level by their texture coordinates.
//
// Where each row of the test matrix is asked ("points": passes/vertex_mapping_check all over a mesh; "images": reuse across the switch;
// "by hand": framework/shaders/lod/vertex_mapping.test.comp, on squares):
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
#include "level_model.h"
#include "shift_session.h"

#include <passes/vertex_mapping_check/vertex_mapping_check.h>

#include <framework/shaders/restir/sample_hit.h>
#include <framework/shaders/world/primary_hit.h>
#include <framework/study/ensemble.h>

#include <set>

namespace lodestir::test {
namespace {

/// A graph in this process whose ports are read after each frame.
class Frames {
public:
    Frames(const Path& scene, glm::uvec2 size, const OrderedJson& passes, std::vector<std::string> ports) {
        SessionOptions options;
        options.graph = folder_.path / "graph.json";
        options.dumps = std::move(ports);
        const OrderedJson graph = {{"format", 1},
                                   {"scene", scene.string()},
                                   {"frame", {{"size", {size.x, size.y}}, {"seed", 1}}},
                                   {"passes", passes},
                                   {"show", options.dumps.at(0)}};
        writeFile(options.graph, graph.dump(2));
        session_ = std::make_unique<Session>(options);
    }
    ~Frames() { EXPECT_EQ(session_->device().validationMessages(), std::vector<std::string>{}); }

    const Scene& scene() const { return session_->scene(); }
    void set(const std::string& parameter, const Json& value) { setParameter(session_->graph(), parameter, value); }
    /// Starts again at a frame of the scene, without history.
    void restart(std::uint32_t frame, std::uint32_t seed) {
        session_->graph().description.seed = seed;
        session_->runner().reset();
        session_->runner().setFrame(frame);
    }
    void run(int frames = 1) {
        for (int i = 0; i < frames; ++i) session_->runner().run();
    }
    ImageData image(const std::string& port) { return session_->runner().readImage(findSource(session_->graph(), port)); }
    template <class T> std::vector<T> records(const std::string& port) {
        const std::vector<std::byte> bytes = session_->runner().readBytes(findSource(session_->graph(), port));
        std::vector<T> records(bytes.size() / sizeof(T));
        std::memcpy(records.data(), bytes.data(), bytes.size());
        return records;
    }

private:
    TemporaryFolder folder_;
    std::unique_ptr<Session> session_;
};

/// Sum over the finite values, which all of them must be.
double sumOf(const ImageData& image) {
    double sum = 0;
    for (const float v : image.values) {
        EXPECT_TRUE(std::isfinite(v));
        sum += v;
    }
    return sum;
}

// ---- points ----

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
        for (const float v : {p.area, p.stretch, p.errorJacobian, p.errorReturn, p.finiteDifference, p.image.x, p.image.y, p.image.z}) EXPECT_TRUE(std::isfinite(v));
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
    std::printf("%-18s mapped %.5f of the area, %zu of %zu points, %zu lost on the way back; return <= %.1e, |JJ'-1| <= %.1e, differences %zu <= %.1e; %zu past a nearer one, %zu thin\n",
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
                const std::string name = mesh.name + " " + std::to_string(a) + ">" + std::to_string(b), inverse = mesh.name + " " + std::to_string(b) + ">" + std::to_string(a);
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
    std::printf("cube: %zu of %zu points with six on both levels, %zu on a face, %zu of them to another, %zu past a nearer one\n", six, mapped.size(), clear, other, passed);
    EXPECT_GT(six, mapped.size() * 99 / 100);
    EXPECT_GT(clear, mapped.size() / 2);
    EXPECT_EQ(other, 0u);
    EXPECT_EQ(passed, 0u);
    for (const MappingCheck& p : points.map(cube, 0, 1, false)) EXPECT_FALSE(has(p, MAPPING_THERE));
}

/// Models written by the tests themselves.
class Sheets : public testing::Test {
protected:
    /// A scene of models in the folder, seen from above; `schedule` as in scene files.
    Path write(const std::string& name, const std::vector<std::string>& models, const OrderedJson& schedule, const OrderedJson& extra = OrderedJson::object()) {
        OrderedJson scene = {{"format", 1},
                             {"models", OrderedJson::object()},
                             {"environment", {{"type", "constant"}, {"color", {0.8, 0.9, 1.0}}, {"strength", 1}}},
                             {"lights", OrderedJson::array({OrderedJson{{"type", "directional"}, {"direction", {0.5, -1, -0.4}}, {"intensity", 2}}})},
                             {"camera", {{"position", {0.4, 2.6, 2.6}}, {"target", {0, 0.1, 0}}, {"fovy", 44}}},
                             {"lod", {{"mode", "schedule"}, {"schedule", schedule}}}};
        for (const std::string& model : models) scene["models"][model] = {{"file", model + ".gltf"}};
        scene.update(extra);
        writeFile(folder.path / (name + ".json"), scene.dump(2));
        return folder.path / (name + ".json");
    }
    /// The same of one new model.
    Path write(const std::string& name, const std::vector<SheetLevel>& levels, const OrderedJson& schedule, const LevelModelLook& look = {}) {
        writeLevels(folder.path, name, levels, look);
        return write(name, {name}, schedule);
    }
    static OrderedJson switchAt(int frame, int level = 1) { return OrderedJson::array({OrderedJson{{"frame", frame}, {"level", level}}}); }
    std::vector<MappingCheck> map(const std::vector<SheetLevel>& levels, int from, int to, glm::uvec2 size = {64, 64}) {
        Points points(write("points", levels, switchAt(1)), size);
        return points.map(0, from, to);
    }

    TemporaryFolder folder;
};

using PointsOfSheets = Sheets;

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
    const std::vector<SheetLevel> levels{{.cells = 8, .place = flat, .uv = doubled}, {.cells = 4, .place = flat, .uv = doubled, .has = [](glm::dvec2 cell) { return cell.x > 0.5; }}};
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

/// Every third row of cells has one coordinate for all of a cell.
std::optional<glm::dvec2> pinched(const SheetPoint& p) {
    return int(p.cell.y * 9) % 3 == 1 ? p.cell : p.at;
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

// ---- images ----

/// graphs/restir_lod.json without tone mapping, its temporal paths kept by themselves.
OrderedJson reuseNodes(OrderedJson temporal = OrderedJson::object()) {
    OrderedJson in = pathsOf("initial", "temporal");
    in.update(OrderedJson{{"worldPrev", "lod.world@prev"}, {"uv", "uv"}});
    OrderedJson hits = hitsNode();
    hits["in"]["worldPrev"] = "lod.world@prev";
    return {{"lod", {{"type", "lod_select"}}},
            {"uv", {{"type", "lod_uv_bvh_build"}}},
            {"hits", hits},
            {"initial", initialNode({{"bounces", 3}})},
            {"temporal", node("temporal_splat", in, std::move(temporal))},
            {"shade", shadeNode("temporal")}};
}

class Images : public Sheets {
protected:
    /// Level 0, 1, 0, 1, ... up to a frame.
    static OrderedJson flicker(int frames) {
        OrderedJson schedule = OrderedJson::array();
        for (int frame = 0; frame < frames; ++frame) schedule.push_back({{"frame", frame}, {"level", frame % 2}});
        return schedule;
    }
    static std::optional<glm::dvec2> unmapped(const SheetPoint&) { return std::nullopt; }
};

// The switch to the same surface cut otherwise changes nothing: all paths that land, land where they were, with the weights they had.
TEST_F(Images, Identity) {
    const std::vector<SheetLevel> levels{{.cells = 8, .place = flat}, {.cells = 8, .place = flat, .otherDiagonal = true}};
    const Path scene = write("identity", levels, switchAt(3));
    Frames frames(scene, {48, 32}, reuseNodes({{"suffix", "walked"}}), {"shade.color", "temporal.landed"});
    std::array<ImageData, 2> images, landed;
    for (const int switching : {0, 1}) {
        frames.set("lod.mode", Json(switching ? "scene" : "finest"));
        frames.restart(0, 7);
        frames.run(4);
        images[std::size_t(switching)] = frames.image("shade.color");
        landed[std::size_t(switching)] = frames.image("temporal.landed");
    }
    std::size_t different = 0, elsewhere = 0;
    for (int y = 0; y < 32; ++y) {
        for (int x = 0; x < 48; ++x) {
            elsewhere += landed[0].at(x, y, 0) != landed[1].at(x, y, 0);
            different += std::abs(images[0].at(x, y, 1) - images[1].at(x, y, 1)) > 1e-3f * images[0].at(x, y, 1);
        }
    }
    const double energy = sumOf(images[1]) / sumOf(images[0]), paths = sumOf(landed[1]) / sumOf(landed[0]);
    std::printf("identity: energy %.5f, landed %.5f of the run without a switch; %zu pixels differ, %zu land elsewhere, of 1536\n", energy, paths, different, elsewhere);
    EXPECT_LT(different, 16u);
    EXPECT_LT(elsewhere, 16u);
    EXPECT_NEAR(energy, 1, 1e-3);
    EXPECT_NEAR(paths, 1, 1e-3);
}

// Two instances of one model, of which the left one switches: each path stays on its instance, with its coordinate; the right one keeps its
// triangles.
TEST_F(Images, OneOfTwoInstances) {
    writeLevels(folder.path, "bowl", {{.cells = 20, .place = bowl}, {.cells = 6, .place = bowl}});
    const Path scene = write("two", {"bowl"}, OrderedJson::array({OrderedJson{{"frame", 3}, {"level", 1}, {"instance", "left"}}}),
                             {{"instances", OrderedJson::array({OrderedJson{{"model", "bowl"}, {"name", "left"}, {"translation", {-0.9, 0, 0}}, {"scale", 0.8}},
                                                                OrderedJson{{"model", "bowl"}, {"name", "right"}, {"translation", {0.9, 0, 0}}, {"scale", 0.8}}})}});
    Frames frames(scene, {64, 36}, reuseNodes({{"backup", 0}}), {"shade.color", "temporal.samples", "initial.samples", "temporal.landed"});
    frames.run(3);
    // A coordinate is carried along; where x1 is found by tracing again it is that of the same point, but for rounding.
    std::vector<SampleHit> before = frames.records<SampleHit>("temporal.samples");
    frames.run();
    const std::vector<SampleHit> now = frames.records<SampleHit>("temporal.samples"), fresh = frames.records<SampleHit>("initial.samples");
    const std::uint32_t left = 0, fine = 20 * 20 * 2;
    std::array<std::size_t, 2> kept{};
    for (std::size_t i = 0; i < now.size(); ++i) {
        const PrimaryHit& hit = now[i].hit;
        if (hit.primitive == NONE || (hit.instance == fresh[i].hit.instance && now[i].uv == fresh[i].uv)) continue;
        ++kept[hit.instance];
        const bool known = std::ranges::any_of(before, [&](const SampleHit& s) {
            const bool same = s.hit.primitive != NONE && s.hit.instance == hit.instance && glm::distance(s.uv, now[i].uv) < 1e-5f;
            return same && (hit.instance == left || s.hit.primitive == hit.primitive);
        });
        EXPECT_TRUE(known) << "pixel " << i << ": a path from another instance, coordinate, or (on the right) triangle";
        EXPECT_EQ(hit.primitive >= fine, hit.instance == left);
    }
    std::printf("two instances: %zu paths of last frame on the one that switched, %zu on the other\n", kept[0], kept[1]);
    EXPECT_GT(kept[0], 100u);
    EXPECT_GT(kept[1], 100u);
    sumOf(frames.image("shade.color"));
    sumOf(frames.image("temporal.landed"));
}

// A mesh that emits stays at its finest whatever the schedule says, because lists of lights are of its triangles; one that doesn't switches.
TEST_F(Images, EmitterStaysAtItsFinest) {
    const std::vector<SheetLevel> levels{{.cells = 8, .place = bowl}, {.cells = 4, .place = bowl}};
    writeLevels(folder.path, "lamp", levels, {.emission = {5, 4, 3}});
    writeLevels(folder.path, "bowl", levels);
    const Path scene = write("lit", {"lamp", "bowl"}, switchAt(2),
                             {{"instances", OrderedJson::array({OrderedJson{{"model", "lamp"}, {"translation", {-0.7, 0.3, 0}}, {"scale", 0.5}},
                                                                OrderedJson{{"model", "bowl"}, {"translation", {0.5, 0, 0}}}})}});
    Frames frames(scene, {64, 36}, reuseNodes(), {"shade.color", "hits.hits"});
    // Levels lie one behind the other: 128 and 32 triangles of the lamp, then of the bowl.
    ASSERT_EQ(frames.scene().meshes.size(), 2u);
    ASSERT_EQ(frames.scene().meshes[0].levels.size(), 2u);
    for (int frame = 0; frame < 4; ++frame) {
        frames.run();
        std::array<std::size_t, 2> seen{};
        for (const PrimaryHit& hit : frames.records<PrimaryHit>("hits.hits")) {
            if (hit.primitive == NONE) continue;
            ++seen[hit.instance];
            const bool coarse = hit.instance == 0 ? hit.primitive >= 128 : hit.primitive >= 160 + 128;
            EXPECT_EQ(coarse, hit.instance == 1 && frame >= 2) << "frame " << frame;
        }
        EXPECT_GT(std::min(seen[0], seen[1]), 50u);
        sumOf(frames.image("shade.color"));
    }
}

/// The coarse level is a ridge that hides much of what the camera saw.
glm::dvec3 ridge(glm::dvec2 p) {
    const glm::dvec3 b = bowl(p);
    return {b.x, b.y + 0.9 * std::exp(-20 * (p.y - 0.75) * (p.y - 0.75)), b.z};
}

TEST_F(Images, SelfOccluding) {
    const Path scene = write("hidden", {{.cells = 20, .place = bowl}, {.cells = 10, .place = ridge}}, switchAt(3));
    Frames frames(scene, {64, 36}, reuseNodes({{"backup", 0}}), {"shade.color", "temporal.landed"});
    frames.run(3);
    const double before = sumOf(frames.image("temporal.landed"));
    frames.run();
    const double at = sumOf(frames.image("temporal.landed"));
    sumOf(frames.image("shade.color"));
    frames.run();
    const double after = sumOf(frames.image("temporal.landed"));
    std::printf("self-occluding: %.0f paths landed in the frame before the switch, %.0f in its own, %.0f in the next\n", before, at, after);
    EXPECT_LT(at, 0.9 * before);
    EXPECT_GT(at, 0.1 * before);
    EXPECT_GT(after, at);
}

/// Mean squared error of two images of a frame, over runs: with reuse across the switch and by spatial reuse alone.
struct Errors {
    double mapped = 0, spatial = 0;
};

// At every frame another level, with normals that differ: reuse is worth its while all the same.
TEST_F(Images, ReusePays) {
    const glm::dvec3 tilted = glm::normalize(glm::dvec3(0.25, 1, 0.1));
    const std::vector<SheetLevel> same{{.cells = 20, .place = bowl}, {.cells = 16, .place = bowl}};
    std::vector<SheetLevel> different = same;
    different[0].normal = glm::dvec3(0, 1, 0);
    different[1].normal = tilted;
    const glm::uvec2 size{32, 18};
    const int last = 4;
    for (const auto& [name, levels] : {std::pair<const char*, const std::vector<SheetLevel>&>{"flicker", same}, {"normals", different}}) {
        const Path scene = write(name, levels, flicker(last + 2));
        Frames reference(scene, size, {{"trace", node("path_tracer", OrderedJson::object(), {{"spp", 1024}, {"bounces", 3}})}}, {"trace.color"});
        reference.restart(last, 1);
        reference.run();
        const ImageData right = reference.image("trace.color");

        OrderedJson nodes = reuseNodes();
        nodes["temporal"]["in"]["history"] = "spatial.reservoirs@prev";
        nodes["temporal"]["in"]["historySamples"] = "spatial.samples@prev";
        nodes["spatial"] = node("spatial_reuse", pathsOf("temporal"), {{"radius", 5}});
        nodes["alone"] = node("spatial_reuse", pathsOf("initial"), {{"radius", 5}});
        nodes["both"] = shadeNode("spatial");
        nodes["near"] = shadeNode("alone");
        Frames frames(scene, size, nodes, {"both.color", "near.color"});
        Errors errors;
        const auto error = [&](const ImageData& image) {
            double sum = 0;
            for (int y = 0; y < right.height; ++y)
                for (int x = 0; x < right.width; ++x) sum += std::pow(image.at(x, y, 1) - right.at(x, y, 1), 2);
            return sum / (right.width * right.height);
        };
        for (std::uint32_t run = 0; run < 8; ++run) {
            frames.restart(0, 100 + run);
            frames.run(last + 1);
            errors.mapped += error(frames.image("both.color"));
            errors.spatial += error(frames.image("near.color"));
        }
        std::printf("%s: squared error %.3f of what spatial reuse alone has\n", name, errors.mapped / errors.spatial);
        EXPECT_LT(errors.mapped, 0.8 * errors.spatial) << name;
    }
}

/// Reuse across a switch against path tracing.
class Switches : public Images, public testing::WithParamInterface<int> {
protected:
    /// Name, and scene that switches at frame 3.
    std::pair<std::string, Path> make() {
        const auto doubled = [](const SheetPoint& p) { return std::optional(glm::dvec2(p.at.x - (p.cell.x > 0.5 ? 0.5 : 0), p.at.y)); };
        const auto cut = [](double at) {
            return [at](const SheetPoint& p) { return std::optional(glm::dvec2(p.at.x + (p.cell.x > at ? 0.2 : 0), p.at.y)); };
        };
        switch (GetParam()) {
            case 0: return {"identity", write("identity", {{.cells = 8, .place = bowl}, {.cells = 8, .place = bowl}}, switchAt(3))};
            case 1: return {"flicker", write("flicker", {{.cells = 20, .place = bowl}, {.cells = 7, .place = bowl}}, flicker(6))};
            case 2: return {"without coordinates", write("bare", {{.cells = 20, .place = bowl, .uv = unmapped}, {.cells = 7, .place = bowl, .uv = unmapped}}, switchAt(3))};
            case 3:
                return {"unequal counts", write("unequal", {{.cells = 20, .place = bowl, .uv = doubled},
                                                            {.cells = 8, .place = bowl, .uv = [=](const SheetPoint& p) { return p.cell.x > 0.5 ? doubled(p) : p.at + 3.0; }}},
                                                switchAt(3))};
            case 4: return {"moved seam", write("seam", {{.cells = 16, .place = bowl, .uv = cut(0.5)}, {.cells = 8, .place = bowl, .uv = cut(0.375)}}, switchAt(3))};
            case 5: return {"degenerate", write("pinched", {{.cells = 9, .place = bowl, .uv = pinched}, {.cells = 18, .place = bowl}}, switchAt(3))};
            case 6: return {"hidden", write("hidden", {{.cells = 20, .place = bowl}, {.cells = 10, .place = ridge}}, switchAt(3))};
            case 7: return {"moving", write("moving", {{.cells = 20, .place = bowl}, {.cells = 7, .place = bowl}}, switchAt(3), {.moveTo = glm::dvec3(1.2, 0.5, -0.6)})};
            default: {
                writeLevels(folder.path, "lamp", {{.cells = 4, .place = flat}, {.cells = 2, .place = flat}}, {.emission = {6, 5, 4}});
                writeLevels(folder.path, "bowl", {{.cells = 20, .place = bowl}, {.cells = 7, .place = bowl}});
                return {"lamp", write("lit", {"lamp", "bowl"}, switchAt(3),
                                      {{"instances", OrderedJson::array({OrderedJson{{"model", "lamp"}, {"translation", {-0.2, 0.9, -0.3}}, {"scale", 0.3}}, OrderedJson{{"model", "bowl"}}})}})};
            }
        }
    }
};

TEST_P(Switches, KeepTheEnergy) {
    const auto [name, scene] = make();
    const auto graph = [](const char* file, std::optional<std::string> variant, std::vector<StudySetting> set) {
        return StudyGraph{.graph = sourceFolder / "graphs" / file, .variant = variant, .set = std::move(set), .port = {}, .where = {}};
    };
    EnsembleJudge judge({.scene = scene,
                         .size = {32, 18},
                         .warmup = 3,
                         .frame = 3,
                         .runs = 32,
                         .reference = graph("path_tracer.json", "no accumulation", {}),
                         .referenceSamples = 1024});
    const EnsembleResult result = judge.judge(graph("restir_lod.json", {}, {{"initial.candidates", Json(2)}, {"spatial.radius", Json(5)}}));
    std::printf("%s: %+.2f %% +- %.2f %%\n", name.c_str(), 100 * (result.energy[0] / result.referenceEnergy[0] - 1), 100 * result.halfWidth);
    EXPECT_EQ(result.verdict, Verdict::unbiased) << name << ": " << result.reason;
    EXPECT_LE(result.halfWidth, 0.01) << name;
}

INSTANTIATE_TEST_SUITE_P(, Switches, testing::Range(0, 9));

}  // namespace
}  // namespace lodestir::test
