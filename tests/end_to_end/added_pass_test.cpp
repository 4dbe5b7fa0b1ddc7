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
    const std::string usual = (sourceFolder / "build/").string(), ours = std::string(LODESTIR_BUILD_DIR) + "/";
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
    EXPECT_EQ(filesOf(folder / "mine/double_light"), (std::set<std::string>{"double_light.comp", "double_light.cpp", "double_light.json"}));
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
            for (int c = 0; c < 3; ++c) ASSERT_NEAR(twice.at(x, y, c), 2 * once.at(x, y, c), 1e-3f * (1 + 2 * once.at(x, y, c))) << x << ", " << y;

    // The program knows it as it knows its own passes.
    const Output described = lodestir({"passes", "double_light", "--passes", (folder / "mine").string(), "--json"});
    EXPECT_EQ(described.exitCode, 0) << described.err;
    EXPECT_NE(described.out.find("strength"), std::string::npos) << described.out;
}

TEST_F(NewPass, RefusesWhatIsThereAlreadyAndWhatIsNoName) {
    const std::string script = (sourceFolder / "scripts/new_pass").string(), mine = (folder / "mine").string();
    shell(script + " twice --in " + mine);
    const std::string text = readText(folder / "mine/twice/twice.cpp");
    EXPECT_EQ(runProcess({script, "twice", "--in", mine}).exitCode, 1);
    EXPECT_EQ(readText(folder / "mine/twice/twice.cpp"), text);
    for (const char* name : {"Twice", "../twice", "a b", "9lives", "--what"}) EXPECT_EQ(runProcess({script, name, "--in", mine}).exitCode, 2) << name;
    EXPECT_EQ(filesOf(folder / "mine"), (std::set<std::string>{"twice"}));
}

}  // namespace
}  // namespace lodestir::test
