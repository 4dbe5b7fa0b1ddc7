// SPDX-License-Identifier: MIT
#include <framework/app/device_test.h>

#include <framework/core/child.h>
#include <framework/core/log.h>
#include <framework/gpu/commands.h>
#include <framework/graph/renderer.h>
#include <framework/scene/scene.h>

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>

namespace lodestir {
namespace {

class Stopwatch {
public:
    double milliseconds() const { return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start_).count(); }

private:
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// What a task tells of itself.
struct Facts {
    std::string device;
    double compileMilliseconds = 0, milliseconds = 0;  ///< until it could run, and of one run after that
};

void requireSilence(const gpu::Device& device) {
    if (!device.validationMessages().empty()) throw Error("a validation message: " + device.validationMessages()[0]);
}

Facts addNumbers(const DeviceTestOptions& options) {
    constexpr std::uint32_t count = 4096, first = 1000;
    const gpu::Device device({.choice = options.device});
    const Stopwatch compiling;
    const Path shaders = shaderFolder();
    const gpu::Pipeline pipeline(device, gpu::compileShader({.file = shaders / "base/add_numbers.comp", .folders = {shaders}, .generated = {}, .defines = {}}),
                                 {}, sizeof(VkDeviceAddress), "add numbers");
    const gpu::Buffer numbers(device, count * sizeof(std::uint32_t), gpu::Memory::device, "numbers");
    const VkDeviceAddress push = numbers.address();
    const auto add = [&](gpu::Commands& commands) { commands.dispatch(pipeline, std::as_bytes(std::span(&push, 1)), count / 64); };
    gpu::runOnce(device, [&](gpu::Commands& commands) {
        commands.fill(numbers, 0, numbers.size(), first);
        commands.barrier();
        add(commands);
        commands.barrier();
    });
    const double compile = compiling.milliseconds();
    const Stopwatch running;
    gpu::runOnce(device, [&](gpu::Commands& commands) {
        add(commands);
        commands.barrier();
    });
    const double milliseconds = running.milliseconds();
    std::vector<std::uint32_t> sums(count);
    gpu::readBuffer(device, numbers, 0, std::as_writable_bytes(std::span(sums)));
    for (std::uint32_t i = 0; i < count; ++i)
        if (sums[i] != first + 2 * i) throw Error(fmt::format("{} + {} + {} came out as {}", first, i, i, sums[i]));
    requireSilence(device);
    return {device.facts().name, compile, milliseconds};
}

/// Inside of a room that reflects one half and glows with radiance 1 everywhere, four scatterings bring 1 + 1/2 + 1/4 + 1/8 + 1/16.
Facts traceFrame(const DeviceTestOptions& options) {
    constexpr double expected = 1.9375;
    Renderer renderer({.device = options.device, .rays = options.rays});
    Graph graph = renderer.build(graphFolder() / "path_tracer.json",
                                 {.scene = sceneFolder() / "furnace.glb", .size = glm::uvec2(64), .set = {{"trace.bounces", Json(4)}}, .show = "trace"});
    Scene scene = loadScene(graph.description.scene);
    scene.camera.keys = {{.position = {0, 1, 2.5}, .target = {0, 0.9, -0.3}}};
    const std::unique_ptr<Runner> runner = renderer.bringUp(graph, scene);
    runner->run();  // compiles the rest
    double compile = 0, milliseconds = HUGE_VAL;
    for (const ShaderReport& shader : runner->shaders()) compile += shader.compileMilliseconds + shader.driverMilliseconds;
    for (int i = 0; i < 5; ++i) {
        const Stopwatch running;
        runner->run();
        milliseconds = std::min(milliseconds, running.milliseconds());
    }
    const ImageData image = firstChannels(runner->readImage(graph.show), 3);  // the fourth is no light
    double mean = 0;
    for (std::size_t i = 0; i < image.values.size(); ++i) mean += image.values[i] / double(image.values.size());
    if (!(std::abs(mean - expected) < 0.05 * expected)) throw Error(fmt::format("the image's mean is {:.4g} instead of {}", mean, expected));
    requireSilence(renderer.device());
    return {renderer.device().facts().name, compile, milliseconds};
}

struct Task {
    const char* name;
    Facts (*run)(const DeviceTestOptions& options);
};
constexpr Task tasks[] = {{"trivial kernel", addNumbers}, {"path-traced frame", traceFrame}};

std::string durationText(double milliseconds) {
    return milliseconds < 10     ? fmt::format("{:.1f} ms", milliseconds)
           : milliseconds < 1000 ? fmt::format("{:.0f} ms", milliseconds)
                                 : fmt::format("{:.1f} s", milliseconds / 1000);
}

/// Runs a task in a child; the result has "name", "works", and either the facts or a "problem".
Json resultOf(const Task& task, const DeviceTestOptions& options) {
    const ChildEnd end = runInChild(
        [&] {
            log::setQuiet(true);
            const Facts facts = task.run(options);
            Json json = Json::object();
            json["device"] = facts.device;
            json["compileMs"] = facts.compileMilliseconds;
            json["ms"] = facts.milliseconds;
            return json.dump(-1);
        },
        std::chrono::duration<double>(options.limit));
    Json result = Json::object();
    result["name"] = task.name;
    result["works"] = end.way == ChildEnd::Way::returned;
    switch (end.way) {
        case ChildEnd::Way::returned: result.merge(Json::parse(end.text, task.name)); break;
        case ChildEnd::Way::threw: result["problem"] = end.text; break;
        case ChildEnd::Way::overdue: result["problem"] = fmt::format("did not end within {:g} s", options.limit); break;
        case ChildEnd::Way::died:
            result["problem"] = end.signal == 0 ? "ended without a word" : fmt::format("crashed (signal {}, {})", end.signal, ::strsignal(end.signal));
    }
    const std::string hint = "update the Vulkan driver, choose another device with --device, or another driver with VK_DRIVER_FILES";
    if (end.way == ChildEnd::Way::died) result["hint"] = hint;
    if (end.way == ChildEnd::Way::overdue) result["hint"] = "give a slow CPU longer with --limit, " + hint;
    return result;
}

void print(const Json& result) {
    fmt::print("{}: ", result.find("name")->asString());
    if (result.find("works")->asBool()) {
        fmt::print("works, {} to compile, {} a run, on {}\n", durationText(result.find("compileMs")->asNumber()), durationText(result.find("ms")->asNumber()),
                   result.find("device")->asString());
    } else {
        const Json* hint = result.find("hint");
        fmt::print("{}{}\n", result.find("problem")->asString(), hint ? "; " + hint->asString() : "");
    }
}

}  // namespace

int testDevice(const DeviceTestOptions& options) {
    bool works = true;
    Json results = Json::array();
    for (const Task& task : tasks) {
        Json result = Json::object();
        if (works) {
            result = resultOf(task, options);
            works = result.find("works")->asBool();
        } else {
            result["name"] = task.name;
            result["works"] = false;
            result["problem"] = "not tried";
        }
        if (!options.json) print(result);
        std::fflush(stdout);
        results.push(std::move(result));
    }
    if (options.json) {
        Json json = Json::object();
        json["works"] = works;
        json["tests"] = std::move(results);
        fmt::print("{}\n", json.dump());
    }
    return works ? 0 : 1;
}

}  // namespace lodestir
