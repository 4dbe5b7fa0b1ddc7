// SPDX-License-Identifier: MIT
// What is installed works from any place: the prefix is moved, a pass of its own is built against it outside of the tree, and runs.
#include "program.h"

namespace lodestir::test {
namespace {

class Install : public ProgramTest {
protected:
    void SetUp() override {
        succeeds({"cmake", "--install", LODESTIR_BUILD_DIR, "--prefix", (folder / "first").string()});
        ASSERT_FALSE(HasFailure());
        std::filesystem::create_directories(prefix.parent_path());
        std::filesystem::rename(folder / "first", prefix);
    }

    static Output execute(const Arguments& command) { return runProcess(command, {{"LODESTIR_VALIDATION", "1"}}); }
    static std::string succeeds(const Arguments& command) {
        const Output output = execute(command);
        EXPECT_EQ(output.exitCode, 0) << commandText(command) << "\n" << output.out << output.err;
        EXPECT_EQ(output.err.find("validation"), std::string::npos) << output.err;
        return output.out;
    }

    const Path prefix = folder / "elsewhere/lodestir";
    const std::string program = (prefix / "bin/lodestir").string();
};

// A family of an external project: two passes that share a struct and a module, and use a module and a struct of ours.
constexpr const char* edgeHeader = R"(#ifndef TOON_EDGE_H
#define TOON_EDGE_H
#include "base/shared.h"
LODESTIR_SHARED_BEGIN
struct Edge {
    float strength;
    uint pad;
};
LODESTIR_SHARED_END
LODESTIR_SHARED(Edge, "toon/edge.h")
#endif
)";
constexpr const char* edgeModule = R"(#include "restir/reservoir.glsl"
Edge edgeBetween(vec3 a, vec3 b) { return Edge(abs(luminance(a) - luminance(b)) + target(emptyReservoir(1.0)), 0u); }
)";
constexpr const char* findEdges = R"(#include <framework/pass/pass.h>
#include <passes/toon/edge.h>
using namespace lodestir;
struct FindEdges final : Pass {
    In<Image>         color{this, "color", "radiance"};
    Out<Buffer<Edge>> edges{this, "edges", "how much it differs from the pixel beside it", Count::perPixel()};
};
LODESTIR_PASS(FindEdges, "find_edges.comp", "Finds edges.")
)";
constexpr const char* findEdgesShader = R"(#version 460
#include "pass.glsl"
#include "toon/edge.glsl"
void main() {
    if (skip()) return;
    ivec2 p = pixel();
    storeEdges(pixelIndex(p), edgeBetween(colorRgba(p).rgb, colorRgba(ivec2(max(p.x - 1, 0), p.y)).rgb));
}
)";
constexpr const char* ink = R"(#include <framework/pass/pass.h>
#include <passes/restir/reservoir.h>
#include <passes/toon/edge.h>
using namespace lodestir;
struct Ink final : Pass {
    In<Image>                  color{this, "color", "radiance"};
    In<Buffer<Edge>>           edges{this, "edges", "where lines go"};
    Scratch<Buffer<Reservoir>> paths{this, "paths", "nothing yet", Count::perPixel()};
    Out<Image>                 drawn{this, "drawn", "the edges alone", Format::rgba32f};
};
LODESTIR_PASS(Ink, "ink.comp", "Draws edges.")
)";
constexpr const char* inkShader = R"(#version 460
#include "pass.glsl"
void main() {
    if (skip()) return;
    storeDrawn(pixel(), vec4(vec3(edges(pixelIndex(pixel())).strength), 1));
}
)";

// One test, because it takes its time: if it fails, nobody but us can use this.
TEST_F(Install, MovesAndTakesPassesFromOutside) {
    for (const char* file :
         {"lib/liblodestir.so", "lib/lodestir/passes/basic/path_tracer/libpath_tracer.so", "lib/lodestir/passes/basic/path_tracer/path_tracer.comp",
          "share/lodestir/shaders/trace/trace.glsl", "share/lodestir/graphs/restir_pt.json", "share/lodestir/scenes/rock.glb",
          "share/lodestir/studies/lod_restir/fig7.json", "share/lodestir/scripts/report/__main__.py", "share/lodestir/scripts/report/templates/report.html",
          "share/lodestir/scripts/report/viewer.js", "share/lodestir/scripts/slurm/job", "share/lodestir/docs/files.md", "share/lodestir/docs/passes.md",
          "include/lodestir/framework/pass/pass.h", "include/lodestir/passes/restir/reservoir.h"})
        EXPECT_TRUE(std::filesystem::exists(prefix / file)) << file;

    // It uses what is beside it, not the tree that it was built in.
    const Path shader = prefix / "lib/lodestir/passes/basic/tone_map/tone_map.comp", example = shader.parent_path() / "tone_map.json";
    const std::string out = (folder / "out").string();
    succeeds({program, "run", example.string(), "--size", "32x18", "--out", out});
    EXPECT_GT(meanOf(readExr(folder / "out/display.0.exr")), 0.01);
    writeFile(shader, "#version 460\n#include \"pass.glsl\"\nvoid main() { if (!skip()) storeDisplay(pixel(), vec4(0.25)); }\n");
    succeeds({program, "run", example.string(), "--size", "32x18", "--out", out});
    EXPECT_EQ(meanOf(readExr(folder / "out/display.0.exr")), 0.25);
    succeeds({program, "check", (prefix / "share/lodestir/graphs/restir_pt.json").string()});

    // A study draws its report by the installed scripts; where Python lacks a package, it says which.
    const std::string tracer = (prefix / "share/lodestir/graphs/path_tracer.json").string();
    const std::string box = (prefix / "share/lodestir/scenes/cornell.json").string();
    writeFile(folder / "study.json", R"({ "format": 1, "scenes": [")" + box + R"("], "size": [16, 9], "seeds": 2,
        "reference": { "graph": ")" + tracer + R"(", "spp": 8 }, "techniques": { "one": { "graph": ")" + tracer + R"(" } }, "charts": ["error_vs_time"] })");
    const Output study = execute({program, "study", (folder / "study.json").string(), "--out", (folder / "study").string()});
    EXPECT_EQ(study.exitCode, 0) << study.err;
    EXPECT_TRUE(std::filesystem::exists(folder / "study/summary.json"));
    EXPECT_TRUE(std::filesystem::exists(folder / "study/report.html") || study.err.find("install python3") != std::string::npos) << study.err;

    // The installed scripts for clusters hand jobs the installed program.
    writeFile(folder / "bin/sbatch", "#!/bin/sh\necho \"$@\" >&2\necho 7\n");
    std::filesystem::permissions(folder / "bin/sbatch", std::filesystem::perms::owner_all);
    const Path slurm = prefix / "share/lodestir/scripts/slurm";
    const Output submitted = runProcess({(slurm / "submit").string(), (folder / "study.json").string(), (folder / "cluster").string(), "2"},
                                        {{"PATH", (folder / "bin").string() + ":" + std::getenv("PATH")}});
    EXPECT_EQ(submitted.exitCode, 0) << submitted.err;
    EXPECT_NE(submitted.err.find((slurm / "job").string() + " " + program + " "), std::string::npos) << submitted.err;
    EXPECT_TRUE((std::filesystem::status(slurm / "job").permissions() & std::filesystem::perms::owner_exec) != std::filesystem::perms::none);

    // A pass outside of the tree, from the installed template.
    const Path mine = folder / "mine";
    const std::string build = (mine / "build").string(), graph = (mine / "glow/glow.json").string();
    const Arguments runIt{program,  "run",        graph,    "--passes",    build + "/passes", "--size", "32x32",
                          "--show", "new.result", "--dump", "trace.color", "--out",           out};
    succeeds({(prefix / "share/lodestir/scripts/new_pass").string(), "glow", "--in", mine.string()});
    succeeds({"cmake", "-S", (mine / "glow").string(), "-B", build, "-DCMAKE_PREFIX_PATH=" + prefix.string()});
    succeeds({"cmake", "--build", build});
    ASSERT_FALSE(HasFailure());
    succeeds(runIt);
    const double once = meanOf(readExr(folder / "out/trace.color.0.exr")), twice = meanOf(readExr(folder / "out/new.result.0.exr"));
    EXPECT_GT(once, 0.01);
    EXPECT_NEAR(twice, 2 * once, 1e-3 * twice);

    // A family of passes outside of the tree, and with an installed one.
    const Path family = folder / "family";
    const std::string familyBuild = (family / "build").string(), drawing = (family / "toon/ink/ink.json").string();
    const std::string newPass = (prefix / "share/lodestir/scripts/new_pass").string();
    for (const char* pass : {"toon/find_edges", "toon/ink"}) succeeds({newPass, pass, "--in", family.string()});
    ASSERT_FALSE(HasFailure());
    writeFile(family / "toon/edge.h", edgeHeader);
    writeFile(family / "toon/edge.glsl", edgeModule);
    writeFile(family / "toon/find_edges/find_edges.cpp", findEdges);
    writeFile(family / "toon/find_edges/find_edges.comp", findEdgesShader);
    writeFile(family / "toon/ink/ink.cpp", ink);
    writeFile(family / "toon/ink/ink.comp", inkShader);
    writeFile(drawing, R"({ "format": 1, "scene": ")" + (prefix / "share/lodestir/scenes/cornell.json").string() + R"(",
        "passes": { "trace": { "type": "path_tracer" }, "find": { "type": "find_edges", "in": { "color": "trace" } },
                    "ink": { "type": "ink", "in": { "color": "trace", "edges": "find" } } }, "show": "ink" })");
    succeeds({"cmake", "-S", family.string(), "-B", familyBuild, "-DCMAKE_PREFIX_PATH=" + prefix.string()});
    succeeds({"cmake", "--build", familyBuild});
    ASSERT_FALSE(HasFailure());
    succeeds({program, "run", drawing, "--passes", familyBuild + "/passes", "--size", "32x32", "--out", out});
    const double drawn = meanOf(readExr(folder / "out/ink.0.exr"));
    EXPECT_GT(drawn, 0.01);
    succeeds({"cmake", "--install", familyBuild, "--prefix", prefix.string()});
    EXPECT_TRUE(std::filesystem::exists(prefix / "lib/lodestir/passes/toon/edge.glsl"));
    std::filesystem::rename(family / "toon", family / "away");  // what is installed stands by itself
    writeFile(folder / "ink.json", readText(family / "away/ink/ink.json"));
    succeeds({program, "run", (folder / "ink.json").string(), "--size", "32x32", "--out", out});
    EXPECT_EQ(meanOf(readExr(folder / "out/ink.0.exr")), drawn);

    // Built for another framework it is refused before anything of it runs.
    const Path package = prefix / "lib/cmake/lodestir/lodestirConfig.cmake";
    std::string text = readText(package);
    const std::size_t at = text.find(LODESTIR_ABI);
    ASSERT_NE(at, text.npos);
    writeFile(package, text.replace(at, std::string_view(LODESTIR_ABI).size(), "0123456789abcdef"));
    succeeds({"cmake", "--build", build});
    const Output refused = execute(runIt);
    EXPECT_EQ(refused.exitCode, 1);
    EXPECT_EQ(refused.err, graph + ":7:26: pass library \"glow\" was built against framework 0123456789abcdef, this is " LODESTIR_ABI
                                   "; build it again against the framework that it is to run with\n");
}

}  // namespace
}  // namespace lodestir::test
