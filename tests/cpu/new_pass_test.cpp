// SPDX-License-Identifier: MIT
// Adding a technique is one new folder: what scripts/new_pass makes must build by the line it prints and be a graph without mistakes,
// even outside the tree.
#include <framework/core/files.h>

#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <set>
#include <unistd.h>

namespace lodestir {
namespace {

struct Outcome {
    int status;
    std::string output;
};

Outcome shell(const std::string& command) {
    std::FILE* pipe = ::popen((command + " 2>&1").c_str(), "r");
    std::string output;
    std::array<char, 4096> part;
    while (const std::size_t read = std::fread(part.data(), 1, part.size(), pipe)) output.append(part.data(), read);
    return {::pclose(pipe), output};
}

/// What follows `key` on its line.
std::string lineOf(const std::string& text, const std::string& key) {
    const std::size_t at = text.find(key);
    return at == text.npos ? std::string() : text.substr(at + key.size(), text.find('\n', at) - at - key.size());
}

TEST(NewPass, BuildsByHandAndIsFoundOutsideTheTree) {
    const Path folder = Path(testing::TempDir()) / ("lodestir_new_pass_" + std::to_string(::getpid()));
    const std::string script = "LODESTIR_BUILD='" LODESTIR_BUILD_DIR "' '" LODESTIR_SOURCE_DIR "/scripts/new_pass'";
    const Outcome made = shell(script + " shiny_thing --in '" + folder.string() + "'");
    ASSERT_EQ(made.status, 0) << made.output;
    std::set<std::string> files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
        if (entry.is_regular_file()) files.insert(entry.path().filename().string());
    }
    EXPECT_EQ(files, (std::set<std::string>{"CMakeLists.txt", "shiny_thing.comp", "shiny_thing.cpp", "shiny_thing.json"}));

    const Outcome built = shell(lineOf(made.output, "build: "));
    ASSERT_EQ(built.status, 0) << built.output;
    const Outcome checked = shell("'" LODESTIR_BINARY "' check '" + (folder / "shiny_thing/shiny_thing.json").string() + "' --passes '" +
                                  folder.string() + "'");
    EXPECT_EQ(checked.status, 0) << checked.output;
    EXPECT_NE(checked.output.find("shiny_thing"), std::string::npos) << checked.output;
    const Outcome told = shell("'" LODESTIR_BINARY "' passes shiny_thing --passes '" + folder.string() + "'");
    EXPECT_NE(told.output.find("multiplies the radiance"), std::string::npos) << told.output;

    const Outcome inFamily = shell(script + " toon/ink --in '" + folder.string() + "'");
    EXPECT_NE(readText(folder / "CMakeLists.txt").find("lodestir_add_family(toon)"), std::string::npos) << inFamily.output;
    EXPECT_EQ(shell(lineOf(inFamily.output, "build: ")).status, 0) << inFamily.output;
    const Outcome found = shell("'" LODESTIR_BINARY "' passes ink --passes '" + folder.string() + "'");
    EXPECT_EQ(found.status, 0) << found.output;

    const Outcome again = shell(script + " shiny_thing --in '" + folder.string() + "'");
    EXPECT_NE(again.status, 0);
    EXPECT_NE(again.output.find("is there already"), std::string::npos) << again.output;
    EXPECT_NE(shell(script + " Shiny-Thing --in '" + folder.string() + "'").status, 0);
    std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace lodestir
