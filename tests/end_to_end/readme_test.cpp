// SPDX-License-Identifier: MIT
// README's commands do what they say, in its order, with smaller pictures. Each is run here or listed with the reason why not, so that a new one is one or
// the other.
#include "../environment_variable.h"
#include "markdown_page.h"
#include "program.h"

#include <framework/study/study_file.h>

namespace lodestir::test {
namespace {

/// What installs, builds or measures for minutes, and where else it is tested.
const std::map<std::string, std::string> listed{
    {"scripts/demo", "installs and builds; what it runs is run here and in study_run_test"},
    {"scripts/test", "runs this test"},
    {"scripts/film", "takes minutes; it is `run` and `compare` of level_switch_test"},
    {"build/lodestir study", "takes minutes, but for study_run_test's; here the file is read, with all that it names"},
};

std::string withoutComment(const std::string& command) { return command.substr(0, command.find_last_not_of(' ', command.find(" #")) + 1); }

/// The same command of few pixels and frames.
std::string shrunk(std::string command) {
    const auto replace = [&](const char* what, const char* by) { command = std::regex_replace(command, std::regex(what), by); };
    replace("--size [0-9]+x[0-9]+", "--size 48x27");
    replace("--frames [0-9]+", "--frames 2");
    replace("--frame [0-9]+", "--frame 1");
    replace("--pixel [0-9]+,[0-9]+", "--pixel 24,13");
    replace("spp=[0-9]+", "spp=2");
    const bool isView = command.starts_with("build/lodestir view ");
    if (std::regex_search(command, std::regex("^build/lodestir (run|view|probe) ")) && command.find("--size") == command.npos) command += " --size 48x27";
    if (command.starts_with("build/lodestir run ") && command.find("--frames") == command.npos) command += " --frames 2";
    if (command.find("--impostor") != command.npos) command += " --views 6 --resolution 64";
    return isView ? "xvfb-run -a " + command + " --frames 2" : command;
}

class Readme : public ProgramTest {
protected:
    /// A tree that commands can write into without leaving a trace in ours, and the files that README leaves to the reader.
    void SetUp() override {
        for (const char* name : {"graphs", "scenes", "studies"}) std::filesystem::create_directory_symlink(sourceFolder / name, folder / name);
        for (const char* name : {"passes", "scripts"}) std::filesystem::copy(sourceFolder / name, folder / name, std::filesystem::copy_options::recursive);
        std::filesystem::create_directory_symlink(sourceFolder / "framework", folder / "framework");
        std::filesystem::create_directory_symlink(LODESTIR_BUILD_DIR, folder / "build");
        std::filesystem::copy_file(Path(LODESTIR_BUILD_DIR) / "scenes/cornell_glossy.glb", folder / "MODEL.glb");
        run("reference", sourceFolder / "graphs/path_tracer.json",
            {"--scene", (sourceFolder / "scenes/interior.json").string(), "--size", "48x27", "--seed", "2", "--frames", "2"});
        std::filesystem::copy_file(folder / "reference/display.0.exr", folder / "reference.exr");
        writeFile(folder / "paper.mplstyle", "figure.figsize: 7, 2.4\n");
    }

    EnvironmentVariable path{"PATH", ("/usr/bin:" + std::string(std::getenv("PATH"))).c_str()};  // Debian's Python has the report's packages
};

TEST_F(Readme, CommandsWork) {
    std::string page;
    std::set<std::string> unused;
    for (const auto& [command, why] : listed) unused.insert(command);
    int run = 0;
    // The page with nothing but its commands, on the lines where they stand.
    const std::string readme = readText(sourceFolder / "README.md");
    std::vector<std::string> lines(std::size_t(std::ranges::count(readme, '\n')) + 1);
    for (const PageBlock& block : blocksOf(readme)) {
        if (block.language != "sh") continue;
        std::string* line = &lines[std::size_t(block.line - 1)];
        line[-1] = "```sh";
        for (std::size_t i = 0; i < block.lines.size(); ++i, ++line) {
            const std::string command = withoutComment(block.lines[i]);
            const auto reason = std::ranges::find_if(listed, [&](const auto& entry) { return command.starts_with(entry.first); });
            if (reason != listed.end()) {
                unused.erase(reason->first);
                std::smatch file;
                if (std::regex_search(command, file, std::regex("studies/[a-z_0-9/]+\\.json"))) {
                    EXPECT_NO_THROW(loadStudy(sourceFolder / file[0].str())) << command;
                }
            } else if (!command.empty()) {
                ++run;
                *line = shrunk(command);
            }
        }
        *line = "```";
    }
    for (const std::string& line : lines) page += line + "\n";
    EXPECT_TRUE(unused.empty()) << *unused.begin() << " is listed, but not in README.md";
    EXPECT_GE(run, 15);

    // What `scripts/report` draws again is a small study's.
    write("small.json", {{"format", 1},
                         {"scenes", {"scenes/cornell.json"}},
                         {"size", {16, 9}},
                         {"seeds", 2},
                         {"reference", {{"graph", "graphs/path_tracer.json"}, {"spp", 8}}},
                         {"techniques", {{"one", {{"graph", "graphs/path_tracer.json"}}}}}});
    ASSERT_EQ(lodestir({"study", (folder / "small.json").string(), "--out", (folder / "out/equal_cost").string()}).exitCode, 0);

    const Followed followed = followPage(page, "README.md", folder, folder);
    for (const std::string& problem : followed.problems) ADD_FAILURE() << problem;
    EXPECT_EQ(followed.commands + followed.leftOut, run);
    for (const char* made : {"out/display.0.exr", "out/run.json", "error.png", "LEVELS.glb", "passes/bloom/bloom.comp", "passes/restir/glare/glare.cpp",
                             "out/equal_cost/report.html"})
        EXPECT_TRUE(std::filesystem::exists(folder / made)) << made;
    std::printf("README.md: %d commands run, %d without a display left out, %zu kinds listed\n", followed.commands, followed.leftOut, listed.size());
}

}  // namespace
}  // namespace lodestir::test
