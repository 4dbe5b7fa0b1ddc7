// SPDX-License-Identifier: MIT
// A pass is compiled against build/api alone: what an external project can't include, no pass of the tree can.
#include <framework/core/files.h>

#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <unistd.h>

namespace lodestir {
namespace {

class Api : public testing::Test {
protected:
    ~Api() override { std::filesystem::remove_all(folder_); }

    /// What g++ says to a source of these includes, with `flags`, and whether it has no errors.
    std::pair<bool, std::string> compile(const std::string& includes, const std::string& flags) {
        const std::string api = LODESTIR_BUILD_DIR "/api", file = (folder_ / "source.cpp").string();
        writeFile(file, includes);
        const std::string command =
            "g++ -std=c++20 " + flags + " -I" + api + " -I" + api + "/framework/shaders -I" + api + "/passes -include lodestir/abi.h " + file + " 2>&1";
        std::FILE* pipe = ::popen(command.c_str(), "r");
        std::string output;
        std::array<char, 4096> part;
        while (const std::size_t read = std::fread(part.data(), 1, part.size(), pipe)) output.append(part.data(), read);
        return {::pclose(pipe) == 0, output};
    }

    const Path folder_ = Path(testing::TempDir()) / ("lodestir_api_" + std::to_string(::getpid()));
};

TEST_F(Api, HasAllOfFrameworkPassAndNoVulkan) {
    std::string includes;
    for (const auto& entry : std::filesystem::directory_iterator(LODESTIR_SOURCE_DIR "/framework/pass"))
        if (entry.path().extension() == ".h") includes += "#include <framework/pass/" + entry.path().filename().string() + ">\n";
    const auto [good, said] =
        compile(includes + "lodestir::Memory made(lodestir::Frame& f) { return f.upload(std::vector<float>{1}, \"one\"); }\n", "-Wall -Werror -fsyntax-only");
    EXPECT_TRUE(good) << said;
    const auto [listed, files] = compile(includes, "-M");
    EXPECT_TRUE(listed) << files;
    EXPECT_NE(files.find("/api/framework/scene/scene.h"), files.npos);
    EXPECT_EQ(files.find("vulkan"), files.npos) << files;
    EXPECT_EQ(files.find(LODESTIR_SOURCE_DIR "/framework/"), files.npos) << files;
}

TEST_F(Api, HasNothingElse) {
    for (const std::string header : {"framework/gpu/buffer.h", "framework/scene/bvh/mesh_bvh.h", "framework/core/log.h"}) {
        const auto [good, said] = compile("#include <" + header + ">\n", "-fsyntax-only");
        EXPECT_FALSE(good) << header;
        EXPECT_NE(said.find(header + ": No such file"), said.npos) << said;
    }
}

}  // namespace
}  // namespace lodestir
