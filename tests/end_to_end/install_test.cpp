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

// One test, because it takes its time: if it fails, nobody but us can use this.
TEST_F(Install, MovesAndTakesPassesFromOutside) {
    for (const char* file :
         {"lib/liblodestir.so", "lib/lodestir/passes/basic/path_tracer/libpath_tracer.so", "lib/lodestir/passes/basic/path_tracer/path_tracer.comp",
          "share/lodestir/shaders/trace/trace.glsl", "share/lodestir/graphs/restir_pt.json", "share/lodestir/scenes/rock.glb",
          "share/lodestir/studies/lod_restir/fig7.json", "share/lodestir/docs/files.md", "include/lodestir/framework/pass/pass.h"})
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
