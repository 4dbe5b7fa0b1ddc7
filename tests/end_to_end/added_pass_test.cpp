// SPDX-License-Identifier: MIT
// A technique is one new folder: scripts/new_pass makes one outside the tree, it builds by the printed line, runs through --passes, and the
// tree is as it was.
#include "program.h"

namespace lodestir::test {
namespace {

/// The rest of the line that starts with `label`; the build folder in it is ours, whatever its name.
std::string lineAfter(const std::string& text, const std::string& label) {
    const std::size_t start = text.find(label);
    if (start == text.npos) return "";
    std::string line = text.substr(start + label.size(), text.find('\n', start) - start - label.size());
    const std::string usual = (sourceFolder / "build/").string(), ours = LODESTIR_BUILD_DIR "/";
    for (std::size_t at = 0; (at = line.find(usual, at)) != line.npos; at += ours.size()) line.replace(at, usual.size(), ours);
    return line;
}

class NewPass : public ProgramTest {
protected:
    Output shell(const std::string& line) {
        Output output = runProcess({"bash", "-c", "cd " + folder.string() + " && " + line}, {{"LODESTIR_VALIDATION", "1"}});
        EXPECT_EQ(output.exitCode, 0) << line << "\n" << output.out << output.err;
        return output;
    }
    static Output gitStatus() { return runProcess({"git", "-C", sourceFolder.string(), "status", "--porcelain"}); }
};

TEST_F(NewPass, InAnotherFolderBuildsAndRunsAndTouchesNothing) {
    const Output before = gitStatus();
    const std::string made = shell((sourceFolder / "scripts/new_pass").string() + " double_light --in " + (folder / "mine").string()).out;
    EXPECT_EQ(filesOf(folder / "mine/double_light"), (std::set<std::string>{"CMakeLists.txt", "double_light.comp", "double_light.cpp", "double_light.json"}));
    ASSERT_NE(lineAfter(made, "build:"), "") << made;
    ASSERT_NE(lineAfter(made, "run:"), "") << made;
    shell(lineAfter(made, "build:"));
    ASSERT_FALSE(HasFailure());
    shell(lineAfter(made, "run:") + " --size 48x32 --out out --dump trace.color --dump new.result");
    if (before.exitCode == 0) {
        EXPECT_EQ(gitStatus().out, before.out);
    }
    ASSERT_FALSE(HasFailure());

    // The example doubles an image.
    const ImageData once = readExr(folder / "out/trace.color.0.exr"), twice = readExr(folder / "out/new.result.0.exr");
    ASSERT_EQ(twice.width, once.width);
    for (int y = 0; y < once.height; ++y)
        for (int x = 0; x < once.width; ++x)
            for (int c = 0; c < 3; ++c)
                ASSERT_NEAR(twice.at(x, y, c), 2 * once.at(x, y, c), 1e-3f * (1 + 2 * once.at(x, y, c))) << x << ", " << y;

    // The program knows it as it knows its own passes.
    const Output described = lodestir({"passes", "double_light", "--passes", (folder / "mine").string(), "--json"});
    EXPECT_EQ(described.exitCode, 0) << described.err;
    EXPECT_NE(described.out.find("strength"), std::string::npos) << described.out;
}

// If this fails, the checks that all other tests run with find nothing, or a mistake in a shader can't be found.
TEST_F(NewPass, MistakesInItsShaderAreFound) {
    const std::string made = shell((sourceFolder / "scripts/new_pass").string() + " faulty --in mine").out;
    shell(lineAfter(made, "build:"));
    ASSERT_FALSE(HasFailure());
    const auto runWith = [&](const std::string& line, const std::string& flag) {
        writeFile(
            folder / "mine/faulty/faulty.comp",
            "#version 460\n#include \"pass.glsl\"\nvoid main() {\n    if (skip()) return;\n    ivec2 p = pixel();\n    " + line + "\n}\n");
        Arguments arguments{"run",      (folder / "mine/faulty/faulty.json").string(),
                            "--passes", (folder / "mine").string(),
                            "--size",   "48x32",
                            "--show",   "new.result",
                            "--out",    (folder / "out").string()};
        if (!flag.empty()) arguments.push_back(flag);
        return lodestir(arguments);
    };
    const Output clean = runWith("storeResult(p, colorRgba(p));", "");
    EXPECT_EQ(clean.exitCode, 0) << clean.err;
    std::filesystem::remove_all(folder / "out");

    const Output nan = runWith("storeResult(p, p == ivec2(5, 7) ? vec4(uintBitsToFloat(0x7fc00000u)) : colorRgba(p));", "--check-nan");
    EXPECT_EQ(nan.exitCode, 1);
    EXPECT_NE(nan.err.find("new.result"), std::string::npos) << nan.err;
    EXPECT_NE(nan.err.find("(5, 7)"), std::string::npos) << nan.err;
    EXPECT_TRUE(filesOf(folder / "out").empty()) << "a failed run leaves nothing";

    const Output outside = runWith("storeResult(p, colorRgba(p + ivec2(1, 0)));", "--check-bounds");
    EXPECT_EQ(outside.exitCode, 1);
    EXPECT_NE(outside.err.find("\"color\" at (48, "), std::string::npos) << outside.err;
    EXPECT_NE(outside.err.find("32 accesses"), std::string::npos) << "one a row: " << outside.err;

    const Output wrong = runWith("storeResult(p, colour(p));", "");
    EXPECT_EQ(wrong.exitCode, 1);
    EXPECT_NE(wrong.err.find("faulty.comp:6"), std::string::npos) << wrong.err;
    EXPECT_NE(wrong.err.find("colour"), std::string::npos) << wrong.err;
    EXPECT_TRUE(filesOf(folder / "out").empty()) << "a failed run leaves nothing";
}

TEST_F(NewPass, RefusesWhatIsThereAlreadyAndWhatIsNoName) {
    const std::string script = (sourceFolder / "scripts/new_pass").string(), mine = (folder / "mine").string();
    shell(script + " twice --in " + mine);
    const std::string text = readText(folder / "mine/twice/twice.cpp");
    EXPECT_EQ(runProcess({script, "twice", "--in", mine}).exitCode, 1);
    EXPECT_EQ(readText(folder / "mine/twice/twice.cpp"), text);
    for (const char* name : {"Twice", "../twice", "a b", "9lives", "--what"})
        EXPECT_EQ(runProcess({script, name, "--in", mine}).exitCode, 2) << name;
    EXPECT_EQ(filesOf(folder / "mine"), (std::set<std::string>{"twice"}));
}

}  // namespace
}  // namespace lodestir::test
