// SPDX-License-Identifier: MIT
// `lodestir devices`: what the machine's Vulkan devices have, what is done without the rest, and whether it works.
#include <framework/app/commands/commands.h>

#include <framework/app/device_test.h>
#include <framework/app/validators.h>
#include <framework/core/error.h>
#include <framework/core/json.h>
#include <framework/core/log.h>
#include <framework/gpu/device.h>
#include <framework/gpu/jit_cpu.h>
#include <framework/graph/runner.h>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <memory>
#include <optional>
#include <utility>

namespace lodestir {

namespace {

struct Options : DeviceTestOptions {
    bool test = false;
};

/// What a command that renders will say of this device.
std::string reasonOf(const gpu::DeviceFacts& facts, const std::vector<gpu::DeviceFacts>& devices, const std::string& choice) {
    const std::string records = facts.isLavapipe ? "; records are read " + gpu::readsText(facts.readsTexels) : "";
    return fmt::format("{}; rays by {}{}", gpu::whyDevice(devices, choice), whyRayBody(facts), records);
}

Json toJson(const gpu::DeviceFacts& facts, bool chosen) {
    Json json = Json::object();
    json["index"] = facts.index;
    json["name"] = facts.name;
    json["type"] = facts.type;
    json["driver"] = facts.driver;
    json["driverVersion"] = facts.driverVersion;
    json["apiVersion"] = facts.apiVersion;
    json["subgroupSize"] = static_cast<std::int64_t>(facts.subgroupSize);
    json["memoryBytes"] = static_cast<std::int64_t>(facts.memoryBytes);
    json["usable"] = facts.usable();
    json["chosen"] = chosen;
    json["rays"] = std::string(nameOf(chooseRayBody(facts, "")));
    if (facts.isLavapipe) json["records"] = gpu::readsText(facts.readsTexels);
    json["features"] = Json::array();
    for (const gpu::Feature& feature : facts.features) {
        Json row = Json::object();
        row["name"] = feature.name;
        row["required"] = feature.required;
        row["present"] = feature.present;
        if (!feature.required) row["fallback"] = feature.fallback;
        json["features"].push(std::move(row));
    }
    return json;
}

void print(const gpu::DeviceFacts& facts, bool chosen) {
    fmt::print("{} {}: {} ({}){}\n", chosen ? '*' : ' ', facts.index, facts.name, facts.type,
               chosen           ? "  <- chosen"
               : facts.usable() ? ""
                                : "  cannot be used");
    fmt::print("     {} {}, Vulkan {}, {} lanes a subgroup, {:.1f} GiB\n", facts.driver, facts.driverVersion, facts.apiVersion,
               facts.subgroupSize, static_cast<double>(facts.memoryBytes) / (1 << 30));
    for (const gpu::Feature& feature : facts.features) {
        std::string without;
        if (!feature.present) without = feature.required ? "  needed" : "  instead: " + feature.fallback;
        fmt::print("     {:<3} {}{}\n", feature.present ? "yes" : "no", feature.name, without);
    }
}

int listDevices(const Options& options) {
    const std::vector<gpu::DeviceFacts> devices = gpu::listDevices();
    std::optional<std::size_t> chosen;
    std::optional<Error> refusal;  // told after the list, which is what helps
    try {
        chosen = gpu::chooseDevice(devices, options.device);
    } catch (const Error& error) {
        refusal = error;
    }
    Json list = Json::array();
    for (std::size_t i = 0; i < devices.size(); ++i) {
        if (options.json)
            list.push(toJson(devices[i], chosen == i));
        else
            print(devices[i], chosen == i);
    }
    if (chosen && !options.json) fmt::print("device {}, {}\n", devices[*chosen].name, reasonOf(devices[*chosen], devices, options.device));
    if (options.json) fmt::print("{}\n", list.dump());
    if (refusal) log::warn("{}", refusal->what());
    return chosen ? 0 : 1;
}

}  // namespace

void addDevices(CLI::App& app, std::function<int()>& run) {
    CLI::App* command = app.add_subcommand("devices", "Lists devices, each needed feature yes/no, the fallback taken");
    const auto options = std::make_shared<Options>();
    command->add_option("--device", options->device, "index or part of the name: marks what this choice means");
    command->add_flag("--json", options->json, "prints JSON");
    CLI::Option* test = command->add_flag("--test", options->test,
                                          "instead of the list: runs a small kernel and a small frame on the chosen device, apart, and says whether they work");
    command->add_option("--rays", options->rays, "with --test, how rays are traced: packet, lane or ray_query")->check(checkNotEmpty)->needs(test);
    command->add_option("--limit", options->limit, "with --test, seconds that each may take")->check(checkPositive)->needs(test)->capture_default_str();
    command->callback([options, &run] { run = [options] { return options->test ? testDevice(*options) : listDevices(*options); }; });
}

}  // namespace lodestir
