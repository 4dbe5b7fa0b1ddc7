// SPDX-License-Identifier: MIT
// `lodestir passes`: what passes exist and what each declares, for people, programs, editors and the docs.
#include <framework/app/commands/commands.h>
#include <framework/app/command_line.h>
#include <framework/core/log.h>
#include <framework/graph/header.h>
#include <framework/graph/plugins.h>
#include <framework/graph/schema.h>

#include <fmt/format.h>

#include <algorithm>
#include <memory>

namespace lodestir {
namespace {

struct Options {
    std::string name;
    std::vector<Path> folders;
    std::string device, rays;
    bool json = false, schema = false, markdown = false;
};

std::vector<PassType> describeAll(PluginLibraries& libraries, const std::string& name, Problems& problems) {
    std::vector<PluginLibraries::Entry> entries;
    if (name.empty()) {
        entries = libraries.all(problems);
    } else {
        entries.push_back({name, &libraries.find(name)});
    }
    std::vector<PassType> types;
    for (const PluginLibraries::Entry& entry : entries) {
        types.push_back(makePassType(entry.type, *entry.plugin));
        checkDeclaration(*types.back().pass, entry.type, Where{entry.plugin->source}, problems);
    }
    return types;
}

int listPasses(const Options& options) {
    PluginLibraries libraries(options.folders);
    Problems problems;
    const std::vector<PassType> types = describeAll(libraries, options.name, problems);
    if (options.schema) {
        fmt::print("{}\n", graphSchema(types).dump());
    } else if (options.markdown) {
        fmt::print("{}", markdown(types));
    } else if (options.json) {
        Json list = Json::array();
        for (const PassType& type : types) list.push(facts(type));
        fmt::print("{}\n", list.dump());
    } else if (!options.name.empty()) {
        fmt::print("{}", text(types.front()));
    } else {
        std::size_t width = 0;
        for (const PassType& type : types) width = std::max(width, type.type.size());
        for (const PassType& type : types) fmt::print("{:{}}  {}\n", type.type, width, type.doc);
    }
    problems.raise();  // after the list of those that are well
    return 0;
}

}  // namespace

void addPasses(CLI::App& app, std::function<int()>& run) {
    Command command(app, "passes", "Lists what passes exist, or what one of them declares");
    const auto options = std::make_shared<Options>();
    command.option("name", options->name, "a pass type, as graph files write it");
    command.option("--passes", options->folders, "another folder of pass libraries").repeatable();
    CommandOption json = command.flag("--json", options->json, "prints JSON");
    CommandOption schema = command.flag("--schema", options->schema, "prints a JSON Schema of graph files, for editors");
    CommandOption markdown = command.flag("--markdown", options->markdown, "prints the page of the docs");
    json.excludes(schema).excludes(markdown);
    schema.excludes(markdown);
    command.option("--device", options->device, "taken like everywhere; no device is used");
    command.option("--rays", options->rays, "taken like everywhere; no ray is traced");
    command.does(run, [options] { return listPasses(*options); });
}

}  // namespace lodestir
