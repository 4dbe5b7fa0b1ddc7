// SPDX-License-Identifier: MIT
// lodestir lod MODEL: builds levels of detail and writes them into a copy of the model, or bakes its impostors.
#include <framework/app/commands/commands.h>

#include <framework/app/bake_impostors.h>
#include <framework/app/command_line.h>
#include <framework/app/session.h>
#include <framework/app/validators.h>
#include <framework/core/error.h>
#include <framework/core/files.h>
#include <framework/core/json.h>
#include <framework/core/log.h>
#include <framework/scene/lod/model.h>

#include <fmt/format.h>

#include <algorithm>
#include <memory>

namespace lodestir {
namespace {

struct LodArguments {
    std::string model, out;
    LodModelOptions options;
    bool json = false, force = false, impostor = false, keepNormals = false;
    BakeOptions bake;
};

Json count(std::size_t value) { return Json(static_cast<std::int64_t>(value)); }

Json levelJson(std::size_t triangles, float coverage) {
    Json level = Json::object();
    level["triangles"] = count(triangles);
    level["coverage"] = Json(double(coverage));
    return level;
}

Json toJson(const LodMeshFacts& facts) {
    Json mesh = Json::object(), levels = Json::array(), notes = Json::array();
    mesh["name"] = Json(facts.name);
    mesh["nodes"] = count(facts.nodes);
    mesh["uvs"] = Json(facts.chain.hasUvs);
    Json finest = levelJson(facts.triangles, facts.coverages.empty() ? 0 : facts.coverages[0]);
    finest["error"] = Json(0.0);
    levels.push(finest);
    for (std::size_t k = 0; k < facts.coarserTriangles.size(); ++k) {
        const LodLevel& made = facts.chain.coarser[k];
        Json level = levelJson(facts.coarserTriangles[k], facts.coverages[k + 1]);
        level["error"] = Json(double(made.error));
        level["toFinest"] = Json(double(made.measured.toFinest));
        level["fromFinest"] = Json(double(made.measured.fromFinest));
        level["appearance"] = Json(double(made.measured.appearance));
        if (facts.chain.hasUvs) {
            level["uv"]["mean"] = Json(double(made.measured.uvMean));
            level["uv"]["p99"] = Json(double(made.measured.uv99));
            level["uv"]["largest"] = Json(double(made.measured.uvLargest));
            level["uv"]["lostCoarse"] = Json(double(made.measured.uvLostCoarse));
            level["uv"]["lostFinest"] = Json(double(made.measured.uvLostFinest));
        }
        levels.push(level);
    }
    mesh["levels"] = levels;
    for (const std::string& note : facts.notes) notes.push(Json(note));
    mesh["notes"] = notes;
    return mesh;
}

Json toJson(const BakedMesh& baked) {
    Json mesh = Json::object();
    mesh["name"] = Json(baked.name);
    mesh["meshes"] = count(baked.meshes);
    mesh["views"] = Json(baked.views);
    mesh["resolution"] = Json(baked.resolution);
    mesh["bytes"] = count(baked.bytes);
    mesh["rawBytes"] = count(baked.rawBytes);
    mesh["coverage"] = Json(baked.coverage);
    mesh["seconds"] = Json(baked.seconds);
    mesh["cached"] = Json(baked.wasKept);
    return mesh;
}

void addLevels(Json& json, const LodArguments& arguments, const LodModel& model) {
    Json meshes = Json::array(), notes = Json::array();
    json["out"] = Json(arguments.out);
    for (const LodMeshFacts& facts : model.meshes) meshes.push(toJson(facts));
    json["meshes"] = meshes;
    for (const std::string& note : model.notes) notes.push(Json(note));
    json["notes"] = notes;
}

void addImpostors(Json& json, const std::vector<BakedMesh>& baked) {
    Json impostors = Json::array();
    for (const BakedMesh& mesh : baked) impostors.push(toJson(mesh));
    json["impostors"] = impostors;
}

void print(const LodArguments& arguments, const LodModel& model) {
    for (const LodMeshFacts& facts : model.meshes) {
        fmt::print("{}: {} triangles, {} node{}\n", facts.name, facts.triangles, facts.nodes, facts.nodes == 1 ? "" : "s");
        for (std::size_t k = 0; k < facts.coarserTriangles.size(); ++k) {
            const LodLevel& level = facts.chain.coarser[k];
            fmt::print("  level {}: {} triangles, error {:.3g}, from coverage {:.3g}", k + 1, facts.coarserTriangles[k], level.error,
                       facts.coverages[k]);
            if (facts.chain.hasUvs)
                fmt::print("; points of one UV are {:.3g} apart (99 %: {:.3g}), {:.2g} % have no partner", level.measured.uvMean,
                           level.measured.uv99, 100 * std::max(level.measured.uvLostCoarse, level.measured.uvLostFinest));
            fmt::print("\n");
        }
        for (const std::string& note : facts.notes) fmt::print("  {}\n", note);
    }
    for (const std::string& note : model.notes) fmt::print("note: {}\n", note);
    fmt::print("{}: {:.1f} MB\n", arguments.out, double(model.glb.size()) / 1e6);
}

void print(const std::vector<BakedMesh>& baked) {
    for (const BakedMesh& mesh : baked) {
        const std::string how = mesh.wasKept ? "found in the cache" : fmt::format("baked in {:.2f} s", mesh.seconds);
        const std::string several = mesh.meshes > 1 ? fmt::format(" ({} meshes)", mesh.meshes) : "";
        const std::string raw = mesh.bytes < mesh.rawBytes ? fmt::format(" ({:.1f} MB raw)", double(mesh.rawBytes) / 1e6) : "";
        fmt::print("{}{}: {} views of {}x{}, {:.1f} MB{}, {:.2f} % of its surface seen, {}\n", mesh.name, several, mesh.views, mesh.resolution,
                   mesh.resolution, double(mesh.bytes) / 1e6, raw, 100 * mesh.coverage, how);
    }
}

void buildLevels(const LodArguments& arguments, Json& json) {
    if (!arguments.force && isSameFile(arguments.out, arguments.model))
        throw Error(Where{arguments.out}, "--out is the model itself", "name another file, or write over it with --force");
    const LodModel model = buildLodModel(arguments.model, arguments.options);
    writeFile(arguments.out, std::span(model.glb));
    if (arguments.json)
        addLevels(json, arguments, model);
    else
        print(arguments, model);
    const bool any = std::ranges::any_of(model.meshes, [](const LodMeshFacts& facts) { return !facts.coarserTriangles.empty(); });
    if (!any) log::warn("{}: no mesh got any levels", arguments.out);
}

int prepareModel(LodArguments& arguments) {
    if (arguments.out.empty() && !arguments.impostor) refuseOption("--out", "is required, unless --impostor is all that is asked for");
    Json json = Json::object();
    json["model"] = Json(arguments.model);
    arguments.options.chain.fitNormals = !arguments.keepNormals;
    if (!arguments.out.empty()) buildLevels(arguments, json);
    if (arguments.impostor) {
        arguments.bake.meshes = arguments.options.meshes;
        const std::vector<BakedMesh> baked = bakeImpostors(arguments.out.empty() ? arguments.model : arguments.out, arguments.bake);
        if (arguments.json)
            addImpostors(json, baked);
        else
            print(baked);
    }
    if (arguments.json) fmt::print("{}\n", json.dump());
    return 0;
}

}  // namespace

void addLod(CLI::App& app, std::function<int()>& run) {
    const auto arguments = std::make_shared<LodArguments>();
    Command command(app, "lod", "Builds levels of detail that keep UVs, and writes them into a copy of a model; bakes its impostors.");
    command.option("MODEL", arguments->model, "a model (.gltf, .glb)").required();
    command.option("--out", arguments->out, "file to write (.glb); with --impostor it may be left out, and no levels are built")
        .check([](const std::string& name) {
            return Path(name).extension() == ".glb" ? std::string() : "\"" + name + "\" must end in .glb: that is what is written";
        });
    command.option("--levels", arguments->options.chain.levels, "how many there are to be, the finest included (4)")
        .within(2, maxLevels);
    command.option("--ratio", arguments->options.chain.ratio, "triangles of a level over those of the next: 2 or 4 (2)")
        .oneOf({2, 4});
    command.option("--mesh", arguments->options.meshes, "only meshes of this name").repeatable();
    command.flag("--keep-normals", arguments->keepNormals, "vertices of coarser levels keep the finest level's normals");
    command.flag("--force", arguments->force, "write over the model itself where --out names it");
    command.flag("--json", arguments->json, "facts as JSON");
    const auto impostor = command.flag("--impostor", arguments->impostor, "bake impostors of the meshes into the cache, where runs find them");
    const auto setting = [&](const char* option, const std::string& parameter, const std::string& about) {
        const auto take = [arguments, parameter](const std::string& value) { arguments->bake.set.push_back(readSetting("bake." + parameter + "=" + value)); };
        command.taken<std::string>(option, take, about).check(checkNotEmpty).needs(impostor);
    };
    setting("--views", "views", "of an impostor: 6, 12 or 18 (18)");
    setting("--resolution", "resolution", "texels a side of its views, a power of 2 (256)");
    setting("--compression", "compression", "of its texels: none or bc (none)");
    addRendererOptions(command, arguments->bake.renderer);
    command.footer(
        "Error: how far a level is from the finest one, both ways, in units of the mesh (sampled). Normals, UVs and colours count\n"
        "as lengths: of the diagonal of the mesh, a 32nd for a difference of 1 between colours, a 3000th for one of 1 between\n"
        "normals. Coverage: share of the screen. Impostors are found by graphs whose impostor_bake has these views, this resolution and\n"
        "this compression, on the same device, with rays traced in the same way.");
    command.does(run, [arguments] { return prepareModel(*arguments); });
}

}  // namespace lodestir
