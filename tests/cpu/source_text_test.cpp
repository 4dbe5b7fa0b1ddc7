// SPDX-License-Identifier: MIT
// What no compiler says about the text of this tree: lines that are too long, links that lead nowhere.
#include <framework/core/files.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <regex>
#include <set>
#include <sstream>

namespace lodestir {
namespace {

namespace fs = std::filesystem;

const Path root = LODESTIR_SOURCE_DIR;

/// Files of the tree with one of these endings, sorted.
std::vector<Path> filesOf(std::initializer_list<const char*> folders, const std::set<std::string>& endings) {
    std::vector<Path> files;
    for (const char* folder : folders)
        for (const auto& entry : fs::recursive_directory_iterator(root / folder))
            if (entry.is_regular_file() && endings.contains(entry.path().extension().string())) files.push_back(entry.path());
    std::ranges::sort(files);
    return files;
}

/// Calls say(line, "file:number: ") for each line of a file.
template <class Say> void eachLine(const Path& file, const Say& say) {
    std::istringstream text(readText(file));
    int number = 0;
    for (std::string line; std::getline(text, line);) say(line, file.lexically_relative(root).string() + ":" + std::to_string(++number) + ": ");
}

TEST(SourceText, HasNoLineLongerThanTheStyleSays) {
    const std::string style = readText(root / ".clang-format");
    std::smatch limit;
    ASSERT_TRUE(std::regex_search(style, limit, std::regex("ColumnLimit: (\\d+)")));
    const auto most = std::stol(limit[1]);
    for (const Path& file : filesOf({"framework", "passes", "scenes", "tests", "bench"}, {".cpp", ".h", ".glsl", ".comp"}))
        eachLine(file, [&](const std::string& line, const std::string& place) {
            const auto characters = std::ranges::count_if(line, [](char c) { return (static_cast<unsigned char>(c) & 0xc0u) != 0x80u; });  // of UTF-8
            EXPECT_LE(characters, most) << place << "longer than .clang-format says";
        });
}

TEST(SourceText, HasNoLinkThatLeadsNowhere) {
    std::vector<Path> pages = filesOf({"docs", "passes"}, {".md"});
    pages.push_back(root / "README.md");
    const std::regex link("\\]\\(([^)#\\s]+)");
    for (const Path& page : pages)
        eachLine(page, [&](const std::string& line, const std::string& place) {
            for (std::sregex_iterator found(line.begin(), line.end(), link), end; found != end; ++found) {
                const std::string target = (*found)[1];
                if (target.find("://") != target.npos) continue;
                EXPECT_TRUE(fs::exists(page.parent_path() / target)) << place << target;
            }
        });
}

}  // namespace
}  // namespace lodestir
