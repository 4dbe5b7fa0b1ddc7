// SPDX-License-Identifier: MIT
// How fast rays are: this project's bodies and the driver's ray query beside Embree, on the same rays, in one run, repetitions interleaved.
//   bench_rays [--benchmark_filter=REGEX] [--benchmark_repetitions=N]
// Prints medians in million rays a second of wall time, and ratios to Embree's single rays ("xE"; of processor time in brackets, which other
// work on the machine disturbs less), then for how many rays the answer differs from Embree's.
#include <bench/rays_embree.h>
#include <bench/rays_query.h>
#include <bench/rays_scenes.h>
#include <framework/core/error.h>
#include <framework/core/tasks.h>
#include <framework/scene/bvh/bvh.h>

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstring>
#include <ctime>
#include <map>
#include <memory>
#include <optional>

namespace lodestir::bench {
namespace {

constexpr glm::uvec2 size{640, 360};
constexpr std::size_t rayCount = std::size_t(size.x) * size.y;
constexpr std::array<const char*, 3> kinds{"primary", "diffuse", "shadow"};
constexpr std::array<const char*, 4> bodies{"embree", "packet", "lane", "ray_query"};

bool isAnyHit(std::size_t kind) { return kind == 2; }

struct Push {
    std::uint64_t world, rays, hits, counter;
    glm::uvec2 size;
    std::uint32_t anyHit;
};

/// Camera rays; from where they hit, one ray in a cosine-weighted direction and one to a point of a square below the ceiling.
std::array<std::vector<Ray>, 3> makeRays(const Triangles& mesh, const Embree& embree) {
    std::array<std::vector<Ray>, 3> rays;
    const glm::vec3 eye(6, 2.6f, 0.4f), forward = glm::normalize(glm::vec3(0.05f, -0.12f, 1));
    const glm::vec3 right = glm::normalize(glm::cross(forward, glm::vec3(0, 1, 0))), up = glm::cross(right, forward);
    for (std::uint32_t y = 0; y < size.y; ++y) {
        for (std::uint32_t x = 0; x < size.x; ++x) {
            const glm::vec2 film = (glm::vec2(x, y) + 0.5f) / glm::vec2(size) * 2.0f - 1.0f;
            rays[0].push_back({eye, 1e-4f, glm::normalize(forward + right * film.x * 0.8f - up * film.y * 0.45f), 1e4f});
        }
    }
    std::vector<Hit> hits(rayCount);
    embree.trace(rays[0], hits, false);
    for (std::uint32_t i = 0; i < rayCount; ++i) {
        if (hits[i].primitive == NONE) {
            for (const int kind : {1, 2}) rays[kind].push_back({{}, 0, {0, 0, 1}, -1});
            continue;
        }
        const glm::uvec3 corners = mesh.triangles[hits[i].primitive];
        const glm::vec3 a = mesh.positions[corners.x], b = mesh.positions[corners.y], c = mesh.positions[corners.z];
        const glm::vec3 d = rays[0][i].direction, side = glm::normalize(glm::cross(b - a, c - a)), n = glm::dot(side, d) > 0 ? -side : side;
        const glm::vec3 point = eye + d * hits[i].t + n * 1e-3f;
        const auto draw = [&](std::uint32_t k) { return random(i * 4 + k); };
        const glm::vec3 t = glm::normalize(glm::cross(n, std::abs(n.x) > 0.5f ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0)));
        const float angle = 2 * std::numbers::pi_v<float> * draw(1), sine = std::sqrt(draw(2));
        const glm::vec3 scattered = sine * (std::cos(angle) * t + std::sin(angle) * glm::cross(n, t)) + std::sqrt(1 - draw(2)) * n;
        rays[1].push_back({point, 1e-4f, scattered, 1e4f});
        const glm::vec3 toLight = glm::vec3(4 + 4 * draw(3), 4.99f, 4 + 4 * draw(4)) - point;
        rays[2].push_back({point, 1e-4f, glm::normalize(toLight), glm::length(toLight) * 0.999f});
    }
    return rays;
}

/// One scene, in Embree and on the device, with its rays and Embree's answers.
class Course {
public:
    Course(const gpu::Device& device, char name)
        : device_(device), scene_(makeRayScene(name)), flat_(scene_.flat()), embree_(flat_), rays_(makeRays(flat_, embree_)), query_(device, scene_),
          hits_(device, rayCount * sizeof(Hit), gpu::Memory::readback, "hits"), counter_(device, 64, gpu::Memory::readback, "counter") {
        const auto start = std::chrono::steady_clock::now();
        const World world = build();
        milliseconds_ = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
        world_ = gpu::makeBuffer(device_, std::as_bytes(std::span(&world, 1)), "world");
        for (std::size_t kind = 0; kind < kinds.size(); ++kind) {
            rayBuffers_[kind] = gpu::makeBuffer(device_, std::as_bytes(std::span(rays_[kind])), "rays");
            truth_[kind].resize(rayCount);
            embree_.trace(rays_[kind], truth_[kind], isAnyHit(kind));
        }
    }

    std::string title() const {
        return fmt::format("scene {}: {} triangles, {} instances, built in {:.0f} ms", scene_.name, flat_.triangles.size(), scene_.instances.size(),
                           milliseconds_);
    }
    void traceEmbree(std::size_t kind) {
        found_.resize(rayCount);
        embree_.trace(rays_[kind], found_, isAnyHit(kind));
    }
    void trace(const gpu::Pipeline& body, gpu::Commands& commands, std::size_t kind) {
        std::memset(counter_.mapped(), 0, counter_.size());
        const Push push{world_.address(), rayBuffers_[kind].address(), hits_.address(), counter_.address(), size, isAnyHit(kind)};
        commands.begin();
        commands.dispatch(body, std::as_bytes(std::span(&push, 1)), std::uint32_t(workerCount()));
        commands.submit();
        commands.wait();
    }
    /// Rays of the last trace on the device whose answer isn't Embree's: hit or not, and the distance within 2e-3.
    std::size_t mismatches(std::size_t kind) const {
        std::vector<Hit> hits(rayCount);
        gpu::readBuffer(device_, hits_, 0, std::as_writable_bytes(std::span(hits)));
        std::size_t count = 0;
        for (std::size_t i = 0; i < rayCount; ++i) {
            const Hit &a = hits[i], &b = truth_[kind][i];
            const bool hit = b.primitive != NONE;
            count += (a.primitive != NONE) != hit || (hit && !isAnyHit(kind) && !(std::abs(a.t - b.t) <= 2e-3f * std::max(1.0f, b.t)));
        }
        return count;
    }

private:
    World build() {
        std::vector<BvhNode> nodes;
        std::vector<BvhTriangle> triangles;
        std::vector<std::uint32_t> roots;
        std::vector<Bvh> meshes;
        for (const Triangles& mesh : scene_.meshes) {
            const BvhInput input{mesh.positions, mesh.triangles};
            meshes.push_back(buildBvh(input));
            const std::size_t first = triangles.size();
            roots.insert(roots.end(), LEVELS, appendNodes(meshes.back(), nodes, first));
            triangles.resize(first + meshes.back().order.size());
            placeTriangles(input, meshes.back(), std::span(triangles).subspan(first));
        }
        std::vector<Box> boxes;
        std::vector<TraceInstance> instances;
        std::vector<std::uint32_t> levels;
        for (const Placed& placed : scene_.instances) {
            const Bvh& mesh = meshes[placed.mesh];
            boxes.push_back(transformed(boundsOf(scene_.meshes[placed.mesh].positions), placed.toWorld));
            instances.push_back(traceInstance(placed.mesh, {mesh.gridBase, mesh.gridScale}, placed.toWorld));
            levels.push_back(std::uint32_t(levels.size() % LEVELS));
        }
        const Bvh top = buildTopLevel(boxes);
        World w{};
        w.topRoot = appendNodes(top, nodes, 0);
        w.gridBase = top.gridBase;
        w.gridScale = top.gridScale;
        w.tlas = query_.address();
        const auto keep = [&]<class T>(const std::vector<T>& values, const char* name) {
            return buffers_.emplace_back(gpu::makeBuffer(device_, std::as_bytes(std::span(values)), name)).address();
        };
        w.nodes = keep(nodes, "nodes");
        w.triangles = keep(triangles, "triangles");
        w.traceInstances = keep(instances, "instances");
        w.roots = keep(roots, "roots");
        w.levels = keep(levels, "levels");
        return w;
    }

    const gpu::Device& device_;
    RayScene scene_;
    Triangles flat_;
    Embree embree_;
    std::array<std::vector<Ray>, 3> rays_;
    std::array<std::vector<Hit>, 3> truth_;
    std::vector<Hit> found_;
    QueryScene query_;
    std::vector<gpu::Buffer> buffers_;
    gpu::Buffer world_, hits_, counter_;
    std::array<gpu::Buffer, 3> rayBuffers_;
    double milliseconds_ = 0;
};

double processorSeconds() {
    timespec t{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return double(t.tv_sec) + double(t.tv_nsec) * 1e-9;
}

double medianOf(std::vector<double> values) {
    const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

/// Gathers every repetition; prints the table once all are done.
class Table final : public benchmark::BenchmarkReporter {
public:
    bool ReportContext(const Context&) override { return true; }
    void ReportRuns(const std::vector<Run>& runs) override {
        for (const Run& run : runs) {
            if (run.run_type != Run::RT_Iteration || run.error_occurred) continue;
            Times& times = times_[run.run_name.function_name];
            times.wall.push_back(run.real_accumulated_time / double(run.iterations));
            times.processor.push_back(run.counters.at("processor"));
            times.mismatches = std::size_t(run.counters.at("mismatches"));
        }
    }
    void print(const std::map<char, std::unique_ptr<Course>>& courses) const {
        for (const auto& [name, course] : courses) {
            fmt::print("\n{}\n{:<10} {:>8} {:>8} {:>8} {:>8}   {:<14} differ\n", course->title(), "Mrays/s", kinds[0], kinds[1], kinds[2], "all", "xE (cpu)");
            double embreeWall = 0, embreeProcessor = 0;
            for (const char* body : bodies) {
                std::string line = fmt::format("{:<10}", body), differ;
                double wall = 0, processor = 0;
                std::size_t found = 0;
                for (const char* kind : kinds) {
                    const auto times = times_.find(fmt::format("{}/{}/{}", name, body, kind));
                    if (times == times_.end()) continue;
                    ++found;
                    const double seconds = medianOf(times->second.wall);
                    wall += seconds;
                    processor += medianOf(times->second.processor);
                    line += fmt::format(" {:>8.2f}", double(rayCount) / seconds * 1e-6);
                    differ += fmt::format(" {}", times->second.mismatches);
                }
                if (found < kinds.size()) continue;
                if (body == bodies[0]) {
                    embreeWall = wall;
                    embreeProcessor = processor;
                }
                const std::string ratio = fmt::format("{:.3f} ({:.3f})", embreeWall / wall, embreeProcessor / processor);
                fmt::print("{} {:>8.2f}   {:<14}{}\n", line, 3 * double(rayCount) / wall * 1e-6, ratio, differ);
            }
        }
    }

private:
    struct Times {
        std::vector<double> wall, processor;
        std::size_t mismatches = 0;
    };
    std::map<std::string, Times> times_;
};

int run(int argc, char** argv) {
    std::vector<char*> arguments(argv, argv + argc);
    std::array<std::string, 2> defaults{"--benchmark_repetitions=7", "--benchmark_enable_random_interleaving=true"};
    for (std::string& argument : defaults) arguments.insert(arguments.begin() + 1, argument.data());
    int count = int(arguments.size());
    benchmark::Initialize(&count, arguments.data());
    if (benchmark::ReportUnrecognizedArguments(count, arguments.data())) return 2;

    const gpu::Device device;
    gpu::Commands commands(device);
    const Path folder = LODESTIR_SOURCE_DIR;
    std::map<std::string, gpu::Pipeline> pipelines;
    const auto addBody = [&](const char* body, const char* define) {
        const gpu::ShaderSource source{folder / "bench/rays.comp", {folder / "framework/shaders"}, {}, {{define, "1"}}};
        pipelines.emplace(body, gpu::Pipeline(device, gpu::compileShader(source), {}, sizeof(Push), body));
    };
    if (device.facts().isLavapipe && device.facts().subgroupSize == 8) addBody("packet", "TRACE_PACKET");
    addBody("lane", "TRACE_LANE");
    if (device.facts().rayQuery) addBody("ray_query", "BENCH_RAY_QUERY");

    std::map<char, std::unique_ptr<Course>> courses;
    for (const char name : {'a', 'b', 'i'}) {
        const auto& course = courses.emplace(name, std::make_unique<Course>(device, name)).first->second;
        for (const char* body : bodies) {
            if (body != bodies[0] && !pipelines.contains(body)) continue;
            for (std::size_t kind = 0; kind < kinds.size(); ++kind) {
                const auto measure = [&, body, kind, course = course.get()](benchmark::State& state) {
                    const auto once = [&] { body == bodies[0] ? course->traceEmbree(kind) : course->trace(pipelines.at(body), commands, kind); };
                    once();  // compiles, and warms the caches
                    double processor = 0;
                    for ([[maybe_unused]] const auto& iteration : state) {
                        const double processorStart = processorSeconds();
                        const auto start = std::chrono::steady_clock::now();
                        once();
                        state.SetIterationTime(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
                        processor = processorSeconds() - processorStart;
                    }
                    state.counters["processor"] = processor;
                    state.counters["mismatches"] = body == bodies[0] ? 0.0 : double(course->mismatches(kind));
                };
                benchmark::RegisterBenchmark(fmt::format("{}/{}/{}", name, body, kinds[kind]).c_str(), measure)->UseManualTime()->Iterations(1);
            }
        }
    }
    Table table;
    benchmark::RunSpecifiedBenchmarks(&table);
    table.print(courses);
    return 0;
}

}  // namespace
}  // namespace lodestir::bench

int main(int argc, char** argv) {
    try {
        return lodestir::bench::run(argc, argv);
    } catch (const lodestir::Error& error) {
        fmt::print(stderr, "{}\n", error.what());
        return 1;
    }
}
