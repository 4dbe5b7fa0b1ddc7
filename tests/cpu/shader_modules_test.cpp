// SPDX-License-Identifier: MIT
// If these fail, shader modules have grown into a knot: one can't be read, or tested, without all others.
#include <framework/core/files.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace lodestir {
namespace {

/// Rooms of shaderFolder(), each of which may include itself and those before it. Families come after all of them.
const std::vector<std::string> rooms{"base", "world", "texture", "impostor", "surface", "bsdf", "light", "trace", "view"};

/// Modules by name ("world/camera.glsl"), and what each includes. Tests and kernels may include anything.
std::map<std::string, std::vector<std::string>> modulesIn(const Path& root) {
    std::map<std::string, std::vector<std::string>> modules;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(root)) {
        const Path& file = entry.path();
        if (file.extension() != ".glsl" && file.extension() != ".h") continue;
        std::vector<std::string>& includes = modules[file.lexically_relative(root).string()];
        std::istringstream lines(readText(file));
        for (std::string line; std::getline(lines, line);) {
            if (!line.starts_with("#include \"")) continue;
            const std::size_t begin = line.find('"') + 1;
            includes.push_back(line.substr(begin, line.find('"', begin) - begin));
        }
    }
    return modules;
}

std::string roomOf(const std::string& module) { return module.substr(0, module.find('/')); }

TEST(ShaderModules, IncludeDownwardsOnly) {
    const auto modules = modulesIn(shaderFolder());
    EXPECT_GT(modules.size(), 30u);
    for (const auto& [module, includes] : modules) {
        const auto own = std::ranges::find(rooms, roomOf(module));
        EXPECT_NE(own, rooms.end()) << module << " is in a room that this test doesn't know";
        for (const std::string& included : includes)
            EXPECT_LE(std::ranges::find(rooms, roomOf(included)) - rooms.begin(), own - rooms.begin()) << module << " includes " << included;
    }
}

TEST(ShaderModules, OfFamiliesIncludeEachOtherWithoutCircles) {
    const auto modules = modulesIn(familyFolder());
    EXPECT_GT(modules.size(), 20u);
    std::set<std::string> done, open;
    const auto visit = [&](const auto& self, const std::string& module) -> void {
        const auto found = modules.find(module);
        if (found == modules.end() || done.contains(module)) return;
        EXPECT_TRUE(open.insert(module).second) << module << " includes itself by way of others";
        if (testing::Test::HasFailure()) return;
        for (const std::string& included : found->second) self(self, included);
        open.erase(module);
        done.insert(module);
    };
    for (const auto& [module, includes] : modules) visit(visit, module);
}

}  // namespace
}  // namespace lodestir
