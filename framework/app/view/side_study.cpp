// SPDX-License-Identifier: MIT
#include <framework/app/view/side_study.h>

#include <framework/app/view/orbit_camera.h>
#include <framework/core/is_file.h>
#include <framework/study/measured_port.h>
#include <framework/study/pixel_filter.h>

#include <fmt/format.h>

#include <algorithm>

namespace lodestir {
namespace {

constexpr int referenceSamples = 1024;
constexpr int seeds = 4;                       // fewer tell no interval
constexpr std::uint32_t mostFramesBefore = 63;  // of an image that has stood for a day, too

std::string absoluteText(const Path& path) { return std::filesystem::absolute(path).lexically_normal().string(); }

/// What the graph gives a parameter, "pass.parameter"; null: it has none.
const Json* givenBy(const Json& whole, const std::string& name) {
    const std::size_t dot = name.find('.');
    const Json* passes = whole.find("passes");
    const Json* pass = passes ? passes->find(name.substr(0, dot)) : nullptr;
    const Json* set = pass ? pass->find("set") : nullptr;
    return set ? set->find(name.substr(dot + 1)) : nullptr;
}

/// The parameters that differ from the graph file.
std::vector<Setting> settingsOf(const SideGraph& side) {
    std::vector<Setting> settings;
    const auto add = [&](const std::string& name) {
        if (const Json* value = givenBy(side.whole, name)) settings.push_back({name, *value});
    };
    for (const Setting& setting : side.made.settings)
        if (!side.made.set.contains(setting.name)) add(setting.name);
    for (const auto& [name, value] : side.made.set) add(name);
    return settings;
}

/// Whether file, variant and parameters still make what the side runs.
bool comesFromFile(const SideGraph& side, const std::vector<Setting>& settings, PluginLibraries& libraries) {
    if (!side.made.patches.empty()) return false;
    try {
        const GraphOptions changes{.scene = {}, .frames = {}, .size = {}, .seed = {}, .set = settings, .variant = side.made.variant, .show = {}};
        const Json made = buildGraph(loadDescription(side.file, changes), libraries).resolved();
        return made.find("passes")->dump(-1) == side.whole.find("passes")->dump(-1) && made.find("show")->dump(-1) == side.whole.find("show")->dump(-1);
    } catch (const Error&) {
        return false;  // it was edited on
    }
}

/// The places of the pixel and the lens that a reference for the graph has to see through; none where its passes don't say.
std::set<PixelFilter> placesOf(const Graph& graph) { return filtersOf(graph, measuredPort(graph, {})); }

/// A path tracer has no place for all pixels of a frame: over many, those are random places.
PixelFilter filterOfReference(const std::set<PixelFilter>& filters) {
    const auto same = [](const std::string& place) { return place == "centre" ? place : "random"; };
    if (filters.empty()) return {"random", "random"};
    return {same(filters.begin()->film), same(filters.begin()->lens)};
}

class SideStudy {
public:
    SideStudy(const ComparedSetting& setting, const Path& folder) : setting_(setting), folder_(folder), libraries_(setting.passes) {}

    Path write() {
        const Graph b = graphOf(setting_.b);
        reference_ = filterOfReference(placesOf(b));
        Json study = Json::object();
        study["format"] = 1;
        study["about"] = fmt::format("{} as seen in frame {} of a viewer", setting_.scene.stem().string(), setting_.frame);
        study["scenes"] = Json::array();
        study["scenes"].push(sceneOf());
        study["size"] = Json::array();
        for (int i = 0; i < 2; ++i) study["size"].push(std::int64_t(setting_.size[i]));
        study["seeds"] = seeds;
        const std::uint32_t before = std::min({setting_.framesStill > 0 ? setting_.framesStill - 1 : 0, setting_.frame, mostFramesBefore});
        study["frames"]["warmup"] = std::int64_t(before);
        study["frames"]["event"] = std::int64_t(setting_.frame);
        study["reference"] = referenceFor(b);
        if (setting_.a) study["techniques"]["A"] = technique("A", *setting_.a, graphOf(*setting_.a));
        study["techniques"]["B"] = technique("B", setting_.b, b);
        study["metrics"] = Json::array();
        for (const char* metric : {"relmse", "mse", "flip"}) study["metrics"].push(metric);
        const Path file = folder_ / "study.json";
        writeFile(file, study.dump(2) + "\n");
        return file;
    }

private:
    Graph graphOf(const SideGraph& side) { return buildGraph(readDescription(side.whole, side.file), libraries_); }

    Json technique(const std::string& name, const SideGraph& side, const Graph& graph) {
        Json json = Json::object();
        const std::vector<Setting> settings = settingsOf(side);
        if (comesFromFile(side, settings, libraries_)) {
            json["graph"] = absoluteText(side.file);
            if (side.made.variant) json["variant"] = *side.made.variant;
            for (const Setting& setting : settings) json["set"][setting.name] = setting.value;
        } else {
            writeFile(folder_ / (name + ".json"), side.whole.dump(2) + "\n");
            json["graph"] = name + ".json";
        }
        const std::set<PixelFilter> filters = placesOf(graph);
        if (!filters.empty() && filters != std::set{reference_}) json["otherFilter"] = true;
        return json;
    }

    /// Paths as long as those that are judged, else what they lack would count as error.
    Json referenceFor(const Graph& graph) const {
        Json reference = Json::object();
        reference["graph"] = absoluteText(graphFolder() / "path_tracer.json");
        for (const GraphNode& node : graph.nodes)
            for (const Parameter* parameter : node.pass->parameters)
                if (!node.off && parameter->name == "bounces") reference["set"]["trace.bounces"] = writeValue(*parameter, parameter->value);
        reference["set"]["trace.film"] = reference_.film;
        reference["set"]["trace.lens"] = reference_.lens != "centre";
        reference["spp"] = referenceSamples;
        return reference;
    }

    /// The scene file, or one that differs from it by the camera.
    std::string sceneOf() const {
        const Path& scene = setting_.scene;
        if (!setting_.camera) return absoluteText(scene);
        Json json = Json::object();
        if (scene.extension() == ".json") {
            json = Json::load(scene);
            Json& models = json["models"];
            for (const auto& [name, model] : models.members()) relocate(models[name], scene.parent_path());
            if (json.find("environment")) relocate(json["environment"], scene.parent_path());
        } else {
            json["format"] = 1;
            json["models"][scene.stem().string()]["file"] = absoluteText(scene);
        }
        json["camera"] = cameraJson(*setting_.camera);
        const std::string name = scene.stem().string() + ".json";
        writeFile(folder_ / name, json.dump(2) + "\n");
        return name;
    }
    /// A file that is named as one beside the scene; what isn't there is among the generated ones, wherever the scene lies.
    static void relocate(Json& owner, const Path& folder) {
        const Json* file = owner.find("file");
        if (!file) return;
        const Path beside = namedPath(folder, file->asString());
        if (isFile(beside)) owner["file"] = absoluteText(beside);
    }

    const ComparedSetting& setting_;
    Path folder_;
    PluginLibraries libraries_;
    PixelFilter reference_;
};

}  // namespace

Path writeSideStudy(const ComparedSetting& setting, const Path& folder) { return SideStudy(setting, folder).write(); }

}  // namespace lodestir
