// SPDX-License-Identifier: MIT
// The bodies that trace rays agree with each other, and with trying every triangle in double precision.
#include <framework/gpu/acceleration.h>
#include <framework/shaders/world/ray.h>
#include <framework/shaders/world/world.h>
#include <tests/cpu/triangle_soup.h>

#include <glm/gtc/matrix_access.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <memory>
#include <numeric>
#include <optional>

namespace lodestir::test {
namespace {

constexpr float farAway = 1e30f;

/// Meshes with levels, placed: what a World says of them to traversal.
class TraceScene {
public:
    struct Placed {
        std::uint32_t mesh, level;
        glm::mat4 toWorld;
    };

    /// All levels share a grid. `masked` triangles (every n-th, 0: none) let rays through at half of them: materials 1 and 2; panes, every n-th
    /// likewise, some of the light: materials 3, 4 and 5.
    void addMesh(std::vector<Soup> levels, std::uint32_t masked = 0, std::uint32_t panes = 0) {
        Box box;
        for (const Soup& soup : levels)
            for (const glm::vec3 p : soup.positions) box = {glm::min(box.low, p), glm::max(box.high, p)};
        auto& mesh = meshes_.emplace_back();
        for (std::size_t l = 0; l < LEVELS; ++l) {
            if (l >= levels.size()) {
                roots_.push_back(roots_.back());
                meshLevels_.push_back(meshLevels_.back());
                continue;
            }
            const Soup& soup = levels[l];
            std::vector<std::uint32_t> masks(soup.triangles.size(), 0);
            for (std::size_t i = 0; masked != 0 && i < masks.size(); i += masked) masks[i] = 1 + std::uint32_t(i / masked % 2) + 1;
            for (std::size_t i = 0; panes != 0 && i < masks.size(); i += panes) masks[i] = 3 + std::uint32_t(i / panes % 3) + 1;
            const BvhInput input{soup.positions, soup.triangles, masks, box};
            const Bvh bvh = buildBvh(input);
            const auto firstTriangle = std::uint32_t(triangles_.size());
            roots_.push_back(appendNodes(bvh, nodes_, firstTriangle));
            meshLevels_.push_back({firstTriangle, std::uint32_t(bvh.order.size()), 0});
            triangles_.resize(firstTriangle + bvh.order.size());
            placeTriangles(input, bvh, std::span(triangles_).subspan(firstTriangle));
            for (const std::uint32_t t : bvh.order) {
                const auto first = std::uint32_t(3 * primitives_.size());
                primitives_.push_back({first, first + 1, first + 2, masks[t] == 0 ? 0 : masks[t] - 1});
                corners_.push_back({soup.positions[soup.triangles[t].x], soup.positions[soup.triangles[t].y], soup.positions[soup.triangles[t].z]});
            }
            mesh.push_back({bvh, boundsOf(soup.positions), firstTriangle});
        }
    }
    void place(std::uint32_t mesh, const glm::mat4& toWorld, std::uint32_t level = 0) { placed_.push_back({mesh, level, toWorld}); }
    void setLevel(std::size_t instance, std::uint32_t level) { placed_[instance].level = level; }

    /// Uploads; the World's addresses live as long as this scene does.
    World upload(const gpu::Device& device) {
        toObject_.clear();
        std::vector<Box> boxes;
        std::vector<TraceInstance> instances;
        std::vector<uint> levels;
        for (const Placed& p : placed_) {
            Box box;
            for (const Level& level : meshes_[p.mesh]) box.add(transformed(level.box, p.toWorld));
            boxes.push_back(box);
            const Bvh& bvh = meshes_[p.mesh][0].bvh;
            instances.push_back(traceInstance(p.mesh, {bvh.gridBase, bvh.gridScale}, p.toWorld));
            levels.push_back(p.level);
            toObject_.push_back(glm::inverse(glm::dmat4(p.toWorld)));
        }
        const Bvh top = buildTopLevel(boxes);
        std::vector<BvhNode> nodes = nodes_;
        World w{};
        w.topRoot = top.root == bvh_ref::empty ? top.root : appendNodes(top, nodes, 0);
        w.gridBase = top.gridBase;
        w.gridScale = top.gridScale;
        std::vector<MaterialRecord> materials(6);
        for (MaterialRecord& m : materials) {
            m.baseColor = glm::vec4(1);
            m.alphaCutoff = 0.5f;
            m.roughness = 1;
            m.layers = m.baseColorMap.texture = m.metallicRoughnessMap.texture = m.normalMap.texture = m.transmissionMap.texture = NONE;
        }
        materials[1].flags = materials[2].flags = MATERIAL_MASK;
        materials[1].baseColor.a = 0.2f;
        materials[3].flags = materials[4].flags = MATERIAL_PANE | MATERIAL_BLEND;
        materials[3].baseColor.a = 0.25f;
        materials[4].baseColor.a = 0.5f;
        materials[5].flags = MATERIAL_PANE;  // thin glass that reflects nothing
        materials[5].baseColor = tint;
        materials[5].roughness = 0;
        materials[5].transmission = materials[5].ior = 1;
        const auto keep = [&](auto& values, const char* name) {
            if (values.empty()) values.emplace_back();
            return buffers_.emplace_back(gpu::makeBuffer(device, std::as_bytes(std::span(values)), name)).address();
        };
        buffers_.clear();
        w.nodes = keep(nodes, "nodes");
        w.triangles = keep(triangles_, "triangles");
        w.traceInstances = keep(instances, "instances");
        w.roots = keep(roots_, "roots");
        w.levels = keep(levels, "levels");
        w.primitives = keep(primitives_, "primitives");
        w.materials = keep(materials, "materials");
        w.instanceCount = std::uint32_t(placed_.size());
        w.meshLevels = keep(meshLevels_, "mesh levels");
        std::vector<InstanceRecord> records(placed_.size());
        for (std::size_t i = 0; i < records.size(); ++i) {
            records[i].mesh = placed_[i].mesh;
            for (int row = 0; row < 3; ++row) records[i].toWorld[row] = glm::row(placed_[i].toWorld, row);
        }
        std::vector<glm::vec4> positions;
        for (const auto& triangle : corners_)
            for (const glm::vec3& corner : triangle) positions.emplace_back(corner, 0);
        w.positions = keep(positions, "positions");
        std::vector<VertexRecord> vertices(positions.size());
        w.vertices = keep(vertices, "vertices");
        w.instances = keep(records, "instance records");
        if (device.facts().rayQuery) uploadQueries(device, w);
        return w;
    }

    /// Nearest hit by trying every triangle in double precision; `other` gets the distance of the next one.
    /// What is left of the light of an any-hit ray that panes don't end goes to `light`.
    Hit tryAll(const Ray& ray, double& other, glm::dvec3& light) const {
        double best = ray.tMax;
        other = farAway;
        light = glm::dvec3(1);
        Hit hit{ray.tMax, {}, NONE, NONE};
        for (std::size_t i = 0; i < placed_.size(); ++i) {
            const glm::dmat4& toObject = toObject_[i];
            const glm::dvec3 origin(toObject * glm::dvec4(ray.origin, 1)), direction(toObject * glm::dvec4(ray.direction, 0));
            const auto& mesh = meshes_[placed_[i].mesh];
            const Level& level = mesh[std::min<std::size_t>(placed_[i].level, mesh.size() - 1)];
            for (std::uint32_t t = level.firstTriangle; t < level.firstTriangle + level.bvh.order.size(); ++t) {
                if (primitives_[t].material == 1) continue;
                const glm::dvec3 v0(corners_[t][0]), v1(corners_[t][1]), v2(corners_[t][2]);
                const double distance = meet<double>(origin, direction, v0, v1 - v0, v2 - v0);
                if (!(distance > ray.tMin)) continue;
                if (distance < ray.tMax) light *= shareOf(primitives_[t].material);
                if (distance < best) {
                    other = best;
                    best = distance;
                    hit = {float(distance), {}, t, std::uint32_t(i)};
                } else {
                    other = std::min(other, distance);
                }
            }
        }
        return hit;
    }

private:
    struct Level {
        Bvh bvh;
        Box box;
        std::uint32_t firstTriangle;
    };
    /// The driver's structures over the same triangles, of the levels that are shown.
    void uploadQueries(const gpu::Device& device, World& w) {
        const auto keep = [&](const auto& values, const char* name) {
            return buffers_.emplace_back(gpu::makeBuffer(device, std::as_bytes(std::span(values)), name)).address();
        };
        std::vector<std::uint32_t> indices(3 * corners_.size());
        std::iota(indices.begin(), indices.end(), 0u);
        const VkDeviceAddress positions = keep(corners_, "positions"), corners = keep(indices, "indices");
        std::vector<gpu::TriangleGeometry> geometries;
        for (const Placed& p : placed_) {
            const LevelRecord& level = meshLevels_[p.mesh * LEVELS + p.level];
            geometries.push_back({.positions = positions,
                                  .indices = corners + std::uint64_t(level.firstPrimitive) * 12,
                                  .vertices = std::uint32_t(3 * corners_.size()),
                                  .triangles = level.primitiveCount,
                                  .opaque = false});
        }
        structures_ = gpu::buildBottomLevels(device, geometries);
        std::vector<VkAccelerationStructureInstanceKHR> instances(placed_.size());
        for (std::size_t i = 0; i < placed_.size(); ++i) {
            for (int row = 0; row < 3; ++row)
                for (int column = 0; column < 4; ++column) instances[i].transform.matrix[row][column] = placed_[i].toWorld[column][row];
            instances[i].mask = 0xff;
            instances[i].flags = VK_GEOMETRY_INSTANCE_TRIANGLE_FACING_CULL_DISABLE_BIT_KHR;
            if (structures_[i]) instances[i].accelerationStructureReference = structures_[i]->address();
        }
        structures_.push_back(gpu::makeTopLevel(device, keep(instances, "query instances"), std::uint32_t(instances.size())));
        gpu::runOnce(device, [&](gpu::Commands& commands) { structures_.back()->build(commands); });
        w.tlas = structures_.back()->address();
    }
    /// Of light that goes on.
    static glm::dvec3 shareOf(std::uint32_t material) {
        return material == 3 ? glm::dvec3(0.75) : material == 4 ? glm::dvec3(0.5) : material == 5 ? glm::dvec3(tint) : glm::dvec3(0);
    }
    static constexpr glm::vec4 tint{0.9f, 0.6f, 0.3f, 1};
    std::vector<std::vector<Level>> meshes_;
    std::vector<Placed> placed_;
    std::vector<glm::dmat4> toObject_;  ///< parallel to placed_
    std::vector<BvhNode> nodes_;
    std::vector<BvhTriangle> triangles_;
    std::vector<uint> roots_;
    std::vector<PrimitiveRecord> primitives_;
    std::vector<std::array<glm::vec3, 3>> corners_;
    std::vector<LevelRecord> meshLevels_;  ///< m * LEVELS + l
    std::vector<gpu::Buffer> buffers_;
    std::vector<std::unique_ptr<gpu::AccelerationStructure>> structures_;
};

struct Push {
    std::uint64_t world, rays, hits;
    uint count, anyHit;
};

class TraceAgreement : public ::testing::Test {
protected:
    void SetUp() override {
        if (std::ranges::none_of(gpu::listDevices(), &gpu::DeviceFacts::usable)) GTEST_SKIP() << "no usable Vulkan device";
        gpu::DeviceOptions options;
        options.validation = true;
        device_.emplace(options);
        bodies_.push_back({"lane", pipeline("TRACE_LANE")});
        if (device_->facts().isLavapipe && device_->facts().subgroupSize == 8) bodies_.push_back({"packet", pipeline("TRACE_PACKET")});
        if (device_->facts().rayQuery) bodies_.push_back({"ray_query", pipeline("TRACE_RAY_QUERY")});
    }
    void TearDown() override {
        if (!device_) return;
        EXPECT_EQ(device_->validationMessages(), std::vector<std::string>{});
    }

    gpu::Pipeline pipeline(const char* body) {
        const Path folder = Path(LODESTIR_SOURCE_DIR);
        const gpu::ShaderSource source{folder / "tests/end_to_end/trace_agreement.comp", {folder / "framework/shaders"}, {}, {{body, "1"}}};
        return gpu::Pipeline(*device_, gpu::compileShader(source), {}, sizeof(Push), body);
    }
    std::vector<Hit> trace(const gpu::Pipeline& body, const World& w, const std::vector<Ray>& rays, bool anyHit) {
        const gpu::Buffer world = gpu::makeBuffer(*device_, std::span(&w, 1), "world"), in = gpu::makeBuffer(*device_, std::span(rays), "rays");
        const gpu::Buffer out(*device_, rays.size() * sizeof(Hit), gpu::Memory::device, "hits");
        const Push push{world.address(), in.address(), out.address(), uint(rays.size()), anyHit};
        gpu::runOnce(*device_, [&](gpu::Commands& commands) {
            commands.dispatch(body, std::as_bytes(std::span(&push, 1)), uint(rays.size() + 63) / 64);
            commands.barrier();
        });
        std::vector<Hit> hits(rays.size());
        gpu::readBuffer(*device_, out, 0, std::as_writable_bytes(std::span(hits)));
        return hits;
    }

    /// Every body against trying all triangles: the same distance within 1e-4, another triangle only at an equal distance, and for at
    /// most one ray in 10 000 neither (rays through an edge, where rounding decides). Any-hit rays: the same occlusion, or the same light.
    void expectAgreement(TraceScene& scene, const std::vector<Ray>& rays) {
        const World w = scene.upload(*device_);
        std::vector<Hit> truth(rays.size());
        std::vector<double> other(rays.size());
        std::vector<glm::dvec3> light(rays.size());
        std::vector<Ray> shadowRays = rays;
        for (Ray& ray : shadowRays) ray.flags = RAY_THROUGH_PANES;
        for (std::size_t i = 0; i < rays.size(); ++i) truth[i] = scene.tryAll(rays[i], other[i], light[i]);
        const auto found = std::ranges::count_if(truth, [](const Hit& h) { return h.primitive != NONE; });
        EXPECT_GT(found, std::ptrdiff_t(rays.size() / 20));
        for (const auto& [name, body] : bodies_) {
            const std::vector<Hit> hits = trace(body, w, rays, false), any = trace(body, w, rays, true), shadows = trace(body, w, shadowRays, true);
            std::size_t wrong = 0, wrongAny = 0, wrongLight = 0, unequal = 0;
            for (std::size_t i = 0; i < rays.size(); ++i) {
                const bool hit = truth[i].primitive != NONE;
                wrongAny += (any[i].primitive != NONE) != hit;
                wrongLight += glm::distance(lightOf(shadows[i]), light[i]) > 1e-4;
                if (hit != (hits[i].primitive != NONE) || (hit && !near(hits[i].t, truth[i].t))) {
                    ++wrong;
                } else if (hit && (hits[i].primitive != truth[i].primitive || hits[i].instance != truth[i].instance)) {
                    ++unequal;
                    EXPECT_TRUE(near(hits[i].t, other[i])) << name << ", ray " << i;
                } else if (!hit) {
                    EXPECT_EQ(hits[i].t, rays[i].tMax);
                }
            }
            EXPECT_LE(wrong, rays.size() / 10000) << name;
            EXPECT_LE(wrongAny, rays.size() / 10000) << name;
            EXPECT_LE(wrongLight, rays.size() / 10000) << name;
            EXPECT_LE(unequal, rays.size() / 10000) << name;
        }
        if (bodies_.size() < 2 || bodies_[1].first != "packet") return;
        // Between our own bodies only the order differs in which triangles are tried.
        const std::vector<Hit> a = trace(bodies_[0].second, w, rays, false), b = trace(bodies_[1].second, w, rays, false);
        std::size_t differ = 0;
        for (std::size_t i = 0; i < rays.size(); ++i) {
            if (std::memcmp(&a[i], &b[i], sizeof(Hit)) == 0) continue;
            ++differ;
            EXPECT_TRUE(near(a[i].t, b[i].t)) << "ray " << i;
        }
        EXPECT_LE(differ, rays.size() / 10000 + 1);
    }
    static glm::dvec3 lightOf(const Hit& shadow) {
        return shadow.primitive != NONE ? glm::dvec3(0) : glm::dvec3(shadow.t, shadow.barycentrics.x, shadow.barycentrics.y);
    }
    static bool near(double a, double b) { return std::abs(a - b) <= 1e-4 * std::abs(b); }

    std::optional<gpu::Device> device_;
    std::vector<std::pair<std::string, gpu::Pipeline>> bodies_;
};

/// Rays from around the box to points inside of it: neighbours alike for half of them (packets stay together), unlike for the rest.
std::vector<Ray> raysInto(Box box, std::size_t count, std::uint32_t seed) {
    Draws draws(seed);
    const glm::vec3 size = box.high - box.low;
    std::vector<Ray> rays;
    glm::vec3 eye = box.low - 0.5f * size;
    for (std::size_t i = 0; i < count; ++i) {
        const bool together = i / 8 % 2 == 0;
        if (!together || i % 64 == 0) eye = box.low + size * draws.point(-0.5f, 1.5f);
        const glm::vec3 target = box.low + size * (together ? 0.5f + 0.1f * draws.point(-1, 1) : draws.point());
        const float length = draws.number(0.25f, 4);
        // From a distance on where 1e-4 of it is more than what rounding in the grid comes to.
        rays.push_back({eye, 0.02f * glm::length(size) / length, length * glm::normalize(target - eye), farAway});
        if (i % 5 == 0) rays.back().tMax = glm::length(target - eye) / length;
        if (i % 7 == 0) rays.back().direction[int(i % 3)] = 0;
        if (i % 11 == 0) rays.back().tMax = -1;
    }
    return rays;
}

glm::mat4 placement(Draws& draws) {
    const glm::vec3 axis = glm::normalize(draws.point(-1, 1)), size = draws.point(0.2f, 1.5f);
    const float angle = draws.number(0, 6.28f), c = std::cos(angle), s = std::sin(angle);
    const glm::mat3 cross(glm::vec3(0, axis.z, -axis.y), glm::vec3(-axis.z, 0, axis.x), glm::vec3(axis.y, -axis.x, 0));
    const glm::mat3 turn = c * glm::mat3(1) + s * cross + (1 - c) * glm::outerProduct(axis, axis);
    glm::mat4 result(turn * glm::mat3(glm::vec3(size.x, 0, 0), glm::vec3(0, -size.y, 0), glm::vec3(0, 0, size.z)));
    result[3] = glm::vec4(draws.point(-5, 5), 1);
    return result;
}

TEST_F(TraceAgreement, OneMesh) {
    TraceScene scene;
    scene.addMesh({randomSoup(1, 1000, 0.1f)});
    scene.place(0, glm::mat4(1));
    expectAgreement(scene, raysInto({glm::vec3(0), glm::vec3(1)}, 10000, 2));
}

TEST_F(TraceAgreement, LargeTrianglesFarFromTheOrigin) {
    Soup soup = randomSoup(3, 300, 1.0f);
    for (glm::vec3& p : soup.positions) p = p * 10.0f + glm::vec3(1000, -2000, 500);
    TraceScene scene;
    scene.addMesh({soup});
    scene.place(0, glm::mat4(1));
    expectAgreement(scene, raysInto({{1000, -2000, 500}, {1010, -1990, 510}}, 10000, 4));
}

// Levels are read while rays travel: switching them changes what is hit and rebuilds nothing.
TEST_F(TraceAgreement, InstancesWithSwitchedLevels) {
    TraceScene scene;
    scene.addMesh({randomSoup(5, 400, 0.2f), randomSoup(6, 40, 0.5f)});
    scene.addMesh({randomSoup(7, 200, 0.3f), randomSoup(8, 3, 0.8f)});
    scene.addMesh({randomSoup(9, 1, 1.0f), Soup()});  // a level without triangles
    Draws draws(10);
    for (std::uint32_t i = 0; i < 60; ++i) scene.place(i % 3, placement(draws), i % 2);
    const std::vector<Ray> rays = raysInto({glm::vec3(-5), glm::vec3(5)}, 10000, 11);
    expectAgreement(scene, rays);
    for (std::uint32_t i = 0; i < 60; ++i) scene.setLevel(i, 1 - i % 2);
    expectAgreement(scene, rays);
}

TEST_F(TraceAgreement, MasksLetRaysThrough) {
    TraceScene scene;
    scene.addMesh({randomSoup(12, 800, 0.15f)}, 3);
    scene.addMesh({randomSoup(13, 4, 1.0f)}, 1);
    Draws draws(14);
    scene.place(0, glm::mat4(1));
    for (int i = 0; i < 6; ++i) scene.place(1, placement(draws));
    expectAgreement(scene, raysInto({glm::vec3(-0.5f), glm::vec3(1.5f)}, 10000, 15));
}

TEST_F(TraceAgreement, PanesLetLightThrough) {
    TraceScene scene;
    scene.addMesh({randomSoup(18, 300, 0.15f)}, 0, 1);
    scene.addMesh({randomSoup(19, 40, 0.3f)}, 0, 2);
    scene.addMesh({randomSoup(20, 60, 0.3f)}, 3, 2);  // masks, too
    Draws draws(21);
    scene.place(0, glm::mat4(1));
    for (std::uint32_t i = 0; i < 6; ++i) scene.place(1 + i % 2, placement(draws));
    expectAgreement(scene, raysInto({glm::vec3(-0.5f), glm::vec3(1.5f)}, 10000, 22));
}

// Whichever way two triangles are put together, light along their common edge goes through one pane. Rays meet it exactly.
TEST_F(TraceAgreement, PanesOfTwoTrianglesDimOnce) {
    TraceScene scene;
    Soup sheet;
    sheet.add({0, 0, 0}, {1, 0, 0}, {1, 1, 0});
    sheet.add({0, 0, 0}, {1, 1, 0}, {0, 1, 0});
    sheet.add({0, 0, 1}, {1, 0, 1}, {1, 1, 1});  // a sheet that is there twice
    sheet.add({0, 0, 1}, {1, 1, 1}, {1, 0, 1});
    scene.addMesh({sheet}, 0, 1);
    scene.place(0, glm::mat4(1));
    const World w = scene.upload(*device_);
    std::vector<Ray> rays;
    for (int i = 1; i < 16; ++i)
        rays.push_back({.origin = {float(i) / 16, float(i) / 16, 0.5f}, .tMin = 0, .direction = {0, 0, -1}, .tMax = farAway, .flags = RAY_THROUGH_PANES});
    for (int i = 1; i < 16; ++i)
        rays.push_back({.origin = {float(i) / 16, float(i) / 32, 0.5f}, .tMin = 0, .direction = {0, 0, 1}, .tMax = farAway, .flags = RAY_THROUGH_PANES});
    for (const auto& [name, body] : bodies_) {
        for (const Hit& shadow : trace(body, w, rays, true)) {
            EXPECT_EQ(shadow.primitive, NONE) << name;
            const bool once = shadow.t == 0.75f || shadow.t == 0.5f || shadow.t == 0.9f;
            EXPECT_TRUE(once) << name << ": " << shadow.t;
        }
    }
}

TEST_F(TraceAgreement, WhatCannotBeHitIsNotHit) {
    const float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
    TraceScene empty, scene;
    empty.addMesh({Soup()});
    empty.place(0, glm::mat4(1));
    scene.addMesh({randomSoup(16, 1000, 0.5f)});
    scene.place(0, glm::mat4(1));
    std::vector<Ray> rays;
    for (const float bad : {nan, -nan, infinity, -infinity}) {
        for (int axis = 0; axis < 3; ++axis) {
            Ray origin{glm::vec3(0.5f), 0, {1, 1, 1}, farAway}, direction = origin;
            origin.origin[axis] = bad;
            direction.direction[axis] = bad;
            rays.insert(rays.end(), {origin, direction});
        }
        rays.push_back({glm::vec3(0.5f), 0, glm::vec3(bad), farAway});
    }
    rays.push_back({glm::vec3(0.5f), 0, glm::vec3(0), farAway});
    rays.push_back({glm::vec3(0.5f), 0, glm::vec3(0, 0, 1), -1});
    rays.push_back({glm::vec3(0.5f), 0, glm::vec3(0, 0, 1), nan});
    rays.push_back({glm::vec3(0.5f), 2, glm::vec3(0, 0, 1), 1});
    for (TraceScene* s : {&empty, &scene}) {
        const World w = s->upload(*device_);
        for (const auto& [name, body] : bodies_)
            for (const bool anyHit : {false, true})
                for (const Hit& hit : trace(body, w, rays, anyHit)) EXPECT_EQ(hit.primitive, NONE) << name;
    }
}

// The longest way down that a build allows, at both levels: the stack must hold.
TEST_F(TraceAgreement, DeepTrees) {
    Soup chain;
    for (int i = 0; i < 100; ++i) {
        const float at = std::ldexp(1.0f, -i / 3) * (1 + float(i % 3) / 5), size = at * 0.4f;
        chain.add({at, -size, 0}, {at + size, size, 0}, {at, size, size});
    }
    TraceScene scene;
    scene.addMesh({chain});
    for (int i = 0; i < 40; ++i) {
        const float size = std::pow(0.7f, float(i));
        glm::mat4 place(size);
        place[3] = glm::vec4(size, 0, 0, 1);
        scene.place(0, place);
    }
    std::vector<Ray> rays = raysInto({{0, -0.5f, -0.1f}, {3, 0.5f, 0.5f}}, 10000, 17);
    for (std::size_t i = 0; i < rays.size(); i += 3) rays[i] = {{4, 0.001f, 0.002f}, 0, {-1, 0.0001f * float(i % 17), 0.0002f * float(i % 13)}, farAway};
    expectAgreement(scene, rays);
}

}  // namespace
}  // namespace lodestir::test
