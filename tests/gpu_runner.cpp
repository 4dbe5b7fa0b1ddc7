// SPDX-License-Identifier: MIT
// Runs GPU unit tests (<name>.test.comp, written with shaders/base/test.glsl) and prints what failed, with its line.
//
//   gpu_runner [TEST.test.comp ...] [--device NAME|INDEX]
//
// Without names it runs every *.test.comp of the framework's shaders and of the families of passes. Exit code: 0 all passed, 1 something failed, 77 no device.
#include <framework/core/error.h>
#include <framework/core/files.h>
#include <framework/gpu/commands.h>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <sstream>
#include <tuple>
#include <utility>
#include <vector>

using namespace lodestir;

namespace {

constexpr int skipped = 77;              // what ctest takes for "skipped"
constexpr std::size_t shownPerLine = 4;  // failures printed of one line
constexpr std::uint32_t mostRuns = 16;   // failures looked up of one invocation

// What base/test.glsl declares: TestFailure, TestResults and TestPush.
enum Kind : std::uint32_t { boolean, integer, natural, real, nearly };
struct Failure {
    std::uint32_t text, line, kind, component;
    std::uint64_t value, expected;
    float tolerance;
    std::array<std::uint32_t, 3> invocation;
};
static_assert(sizeof(Failure) == 48);
struct Results {
    std::uint32_t checks, failures, most, count;
    std::array<Failure, 1024> recorded;
};
constexpr std::size_t resultBytes = sizeof(Results) + sizeof(std::uint32_t) * (1u << 20);
struct Push {
    std::uint64_t results;
    std::uint32_t pass, skip;
};

// The lines "// groups: 8 8" and "// passes: 2" above the first line of code.
struct Directives {
    std::array<std::uint32_t, 3> groups{1, 1, 1};
    std::uint32_t passes = 1;
};

Directives readDirectives(const Path& path, const std::string& text) {
    Directives directives;
    Problems problems;
    std::istringstream lines(text);
    std::string line;
    for (int number = 1; std::getline(lines, line) && (line.empty() || line.starts_with("//")); ++number) {
        const bool isGroups = line.starts_with("// groups:"), isPasses = line.starts_with("// passes:");
        if (!isGroups && !isPasses) continue;
        std::istringstream words(line.substr(line.find(':') + 1));
        std::vector<std::uint32_t> numbers;
        for (std::uint32_t value; words >> value;) numbers.push_back(value);
        const std::size_t most = isGroups ? 3 : 1;
        if (numbers.empty() || numbers.size() > most || !words.eof() || std::ranges::count(numbers, 0u) > 0)
            problems.add(
                {path.string(), number, 0}, "not a directive",
                isGroups ? "write // groups: followed by one to three positive numbers" : "write // passes: followed by a positive number");
        else if (isGroups)
            std::ranges::copy(numbers, directives.groups.begin());
        else
            directives.passes = numbers[0];
    }
    problems.raise();
    return directives;
}

std::string valueText(std::uint32_t kind, std::uint64_t bits) {
    const auto asFloat = std::bit_cast<float>(static_cast<std::uint32_t>(bits));
    if (kind >= real && std::isnan(asFloat)) return "nan";  // whatever its sign
    switch (kind) {
    case boolean: return bits ? "true" : "false";
    case integer: return fmt::format("{}", static_cast<std::int64_t>(bits));
    case natural: return fmt::format("{}", bits);
    default: return fmt::format("{}", asFloat);  // the shortest text that tells it from its neighbours
    }
}

std::string failureText(const Failure& failure, const std::string& file) {
    std::string text = fmt::format("{}:{}: {}, expected {}", file, failure.line, valueText(failure.kind, failure.value),
                                   valueText(failure.kind, failure.expected));
    if (failure.kind == nearly) text += fmt::format(" +- {}", failure.tolerance);
    if (failure.component < 4) text += fmt::format(" (component {})", "xyzw"[failure.component]);
    const auto& [x, y, z] = failure.invocation;
    return text + (y > 0 || z > 0 ? fmt::format(" (invocation {} {} {})", x, y, z) : fmt::format(" (invocation {})", x));
}

// Prints the failures in the order of their lines, the first few of each line.
void printFailures(std::vector<Failure> failures, const std::vector<Path>& files) {
    const auto place = [](const Failure& f) { return std::pair(f.text, f.line); };
    std::ranges::sort(failures, {}, [&](const Failure& f) {
        return std::tuple(place(f), f.invocation[2], f.invocation[1], f.invocation[0], f.component);
    });
    for (auto first = failures.begin(); first != failures.end();) {
        const auto last = std::find_if(first, failures.end(), [&](const Failure& f) { return place(f) != place(*first); });
        const std::string file = first->text < files.size() ? files[first->text].filename().string() : fmt::format("text {}", first->text);
        const auto count = static_cast<std::size_t>(last - first);
        for (auto f = first; f != first + static_cast<std::ptrdiff_t>(std::min(count, shownPerLine)); ++f)
            fmt::print("{}\n", failureText(*f, file));
        if (count > shownPerLine) fmt::print("{}:{}: and {} more\n", file, first->line, count - shownPerLine);
        first = last;
    }
}

// One run of all passes over fresh results.
Results dispatch(gpu::Commands& commands, const gpu::Device& device, const gpu::Pipeline& pipeline, const gpu::Buffer& buffer,
                 const Directives& directives, std::uint32_t skip) {
    commands.begin();
    commands.fill(buffer, 0, buffer.size(), 0);
    for (std::uint32_t pass = 0; pass < directives.passes; ++pass) {
        const Push push{buffer.address(), pass, skip};
        commands.barrier();
        commands.dispatch(pipeline, std::as_bytes(std::span(&push, 1)), directives.groups[0], directives.groups[1], directives.groups[2]);
    }
    commands.submit();
    commands.wait();
    Results results;
    gpu::readBuffer(device, buffer, 0, std::as_writable_bytes(std::span(&results, 1)));
    return results;
}

// Runs one test; true when it made checks and all of them passed.
bool runTest(const gpu::Device& device, const Path& path) {
    const std::string name = path.filename().string();
    const Directives directives = readDirectives(path, readText(path));
    const gpu::Spirv spirv = gpu::compileShader({path, {shaderFolder(), familyFolder()}, {}, {}, device.facts().readsTexels});
    const gpu::Pipeline pipeline(device, spirv, {}, sizeof(Push), name);
    const gpu::Buffer buffer(device, resultBytes, gpu::Memory::device, "test results");
    gpu::Commands commands(device);
    const Results first = dispatch(commands, device, pipeline, buffer, directives, 0);
    if (first.checks == 0) {
        fmt::print("{}: 0 checks were made, expected some\n", name);
        return false;
    }
    if (first.failures == 0) {
        fmt::print("{}: {} checks passed\n", name, first.checks);
        return true;
    }
    std::vector<Failure> failures;
    for (std::uint32_t skip = 0; skip < std::min(first.most, mostRuns); ++skip) {
        const Results results = skip == 0 ? first : dispatch(commands, device, pipeline, buffer, directives, skip);
        const std::size_t count = std::min<std::size_t>(results.count, results.recorded.size());
        failures.insert(failures.end(), results.recorded.begin(), results.recorded.begin() + static_cast<std::ptrdiff_t>(count));
    }
    printFailures(std::move(failures), spirv.files);
    fmt::print("{}: {} of {} checks failed\n", name, first.failures, first.checks);
    return false;
}

std::vector<Path> allTests() {
    std::vector<Path> tests;
    for (const Path& folder : {shaderFolder(), familyFolder()})
        for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
            if (entry.path().string().ends_with(".test.comp")) tests.push_back(entry.path());
    std::ranges::sort(tests);
    return tests;
}

int runTests(const std::vector<Path>& tests, const std::string& choice) {
    if (choice.empty() && std::ranges::none_of(gpu::listDevices(), &gpu::DeviceFacts::usable)) {
        fmt::print("skipped: no Vulkan device on this machine has what is needed (see `lodestir devices`)\n");
        return skipped;
    }
    const gpu::Device device({choice, /* validation = */ true, {}});
    bool good = true;
    for (const Path& test : tests) {
        try {
            good &= runTest(device, test);
        } catch (const Error& error) {
            fmt::print("{}\n", error.what());
            good = false;
        }
    }
    for (const std::string& message : device.validationMessages()) fmt::print("validation: {}\n", message);
    return good && device.validationMessages().empty() ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app("Runs GPU unit tests");
    std::vector<Path> tests;
    std::string device;
    app.add_option("tests", tests, "*.test.comp files; all of the shader folder when none is named");
    app.add_option("--device", device, "index or part of the name");
    CLI11_PARSE(app, argc, argv);
    try {
        return runTests(tests.empty() ? allTests() : tests, device);
    } catch (const Error& error) {
        fmt::print("{}\n", error.what());
        return 1;
    }
}
