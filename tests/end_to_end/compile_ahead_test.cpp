// SPDX-License-Identifier: MIT
// Kernels compiled on several cores at once, through the driver's cache, are those that one core compiles.
#include "program.h"

namespace lodestir::test {
namespace {

class CompileAhead : public ProgramTest {
protected:
    struct Rendered {
        std::set<std::string> shaders;  ///< "pass: shader"
        std::size_t count = 0;
        ImageData image;
    };
    Rendered render(const std::string& out, Environment environment) {
        environment.emplace_back("LODESTIR_VALIDATION", "1");
        const Output output =
            runProcess({LODESTIR_BINARY, "run", (sourceFolder / "graphs/restir_pt.json").string(), "--scene", (sourceFolder / "scenes/cornell.json").string(),
                        "--size", "32x18", "--frames", "1", "--show", "shade", "--out", (folder / out).string()},
                       environment, std::chrono::seconds(150));
        EXPECT_EQ(output.exitCode, 0) << output.err;
        EXPECT_EQ(output.err.find("validation"), std::string::npos) << output.err;
        if (HasFailure()) return {};
        Rendered result{{}, 0, readExr(folder / out / "shade.0.exr")};
        const OrderedJson report = readJson(folder / out / "run.json");
        for (const OrderedJson& shader : report["setup"]["shaders"]) {
            result.shaders.insert(shader["pass"].get<std::string>() + ": " + shader["shader"].get<std::string>());
            ++result.count;
        }
        return result;
    }
};

TEST_F(CompileAhead, GivesTheImageOfKernelsCompiledOneByOne) {
    const Rendered alone = render("alone", {{"MESA_SHADER_CACHE_DISABLE", "true"}});
    const std::string cache = (folder / "driver").string(), ours = (folder / "ours").string();
    const Environment fresh{{"MESA_SHADER_CACHE_DIR", cache}, {"LODESTIR_CACHE", ours}};
    const Rendered cold = render("cold", fresh), warm = render("warm", fresh);
    if (HasFailure()) return;
    EXPECT_EQ(cold.image.values, alone.image.values);
    EXPECT_EQ(warm.image.values, alone.image.values);
    EXPECT_GE(alone.shaders.size(), 5u);
    EXPECT_EQ(cold.shaders, alone.shaders);
    EXPECT_EQ(cold.count, cold.shaders.size()) << "a kernel was made twice";
    EXPECT_EQ(warm.count, warm.shaders.size());
}

// What cannot be kept is compiled all the same.
TEST_F(CompileAhead, NeedsNoCacheThatCanBeWritten) {
    writeFile(folder / "file", std::string("no folder"));
    const Rendered result = render("out", {{"MESA_SHADER_CACHE_DIR", (folder / "file").string()}});
    EXPECT_FALSE(result.image.values.empty());
}

}  // namespace
}  // namespace lodestir::test
