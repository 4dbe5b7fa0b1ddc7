// SPDX-License-Identifier: MIT
// Shader compilation: includes, places of messages, and the cache that must never answer with an old result.
#include <framework/core/error.h>
#include <framework/core/tasks.h>
#include <framework/gpu/shader.h>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <unistd.h>

namespace lodestir::gpu {
namespace {

// A folder of its own for sources and cache.
class ShaderTest : public ::testing::Test {
protected:
    void SetUp() override {
        folder_ = std::filesystem::temp_directory_path() / ("lodestir_shader_test_" + std::to_string(getpid()));
        std::filesystem::remove_all(folder_);
        setenv("LODESTIR_CACHE", (folder_ / "cache").c_str(), 1);
    }
    void TearDown() override { std::filesystem::remove_all(folder_); }

    Path write(const std::string& name, const std::string& text) {
        writeFile(folder_ / name, text);
        return folder_ / name;
    }
    ShaderSource source(const std::string& entry = "main.comp") const { return {folder_ / entry, {folder_ / "shared"}, {}, {}}; }
    static std::string errorOf(const ShaderSource& source) {
        try {
            compileShader(source);
        } catch (const Error& error) {
            return error.what();
        }
        return "no error";
    }

    Path folder_;
};

const char* const head = "#version 460\nlayout(local_size_x = 8) in;\n";

TEST_F(ShaderTest, TakesEveryFileOnceAndLooksInItsFolders) {
    write("main.comp",
          "#version 460\n#include \"near.glsl\"\n#include \"far.glsl\"\n#include <far.glsl>\n#include \"made.glsl\"\n"
          "layout(local_size_x = 8) in;\nvoid main() { uint x = near() + far() + made() + WANTED; }\n");
    write("near.glsl", "#include \"far.glsl\"\nuint near() { return far(); }\n");
    write("shared/far.glsl", "#include \"deep/deep.glsl\"\nuint far() { return deep(); }\n");
    write("shared/deep/deep.glsl", "uint deep() { return 1u; }\n");
    ShaderSource wanted = source();
    wanted.generated["made.glsl"] = "#include \"far.glsl\"\nuint made() { return far(); }\n";
    wanted.defines = {{"WANTED", "3u"}};
    const Spirv spirv = compileShader(wanted);
    ASSERT_GT(spirv.words.size(), 5u);
    EXPECT_EQ(spirv.words[0], 0x07230203u);  // SPIR-V's magic number
    EXPECT_EQ(spirv.words[1], 0x00010600u);  // 1.6
    const std::vector<Path> files{folder_ / "main.comp", folder_ / "near.glsl", folder_ / "shared/far.glsl",
                                  folder_ / "shared/deep/deep.glsl"};
    std::vector<Path> found = spirv.files;
    std::sort(found.begin(), found.end());
    EXPECT_EQ(found, (std::vector<Path>{files[0], files[1], files[3], files[2]}));
}

TEST_F(ShaderTest, ErrorsNameTheRealFileAndLine) {
    write("main.comp", std::string(head) + "#include \"a.glsl\"\n\nvoid main() { wrong; }\n");
    write("a.glsl", "/* #include \"nowhere.glsl\"\n#include \"nowhere.glsl\" */\nuint a() { return 1u; }\n");
    EXPECT_EQ(errorOf(source()), (folder_ / "main.comp").string() + ":5: 'wrong' : undeclared identifier; in: void main() { wrong; }");
    write("a.glsl", "#include \"b.glsl\"\n#include \"b.glsl\"\nuint a() {\n    return missing;\n}\n");
    write("b.glsl", "uint b() { return 1u; }\n");
    EXPECT_EQ(errorOf(source()), (folder_ / "a.glsl").string() + ":4: 'missing' : undeclared identifier; in: return missing;");
    write("a.glsl", "\n#include \"nowhere.glsl\"\n");
    EXPECT_NE(errorOf(source()).find((folder_ / "a.glsl").string() + ":2: '#include' : no such file"), std::string::npos)
        << errorOf(source());
    EXPECT_NE(errorOf(source("none.comp")).find("none.comp"), std::string::npos);
}

TEST_F(ShaderTest, AnInactiveIncludeMayBeMissing) {
    write("main.comp", std::string(head) + "#ifdef __cplusplus\n#include <vector>\n#endif\nvoid main() {}\n");
    EXPECT_EQ(errorOf(source()), "no error");
}

TEST_F(ShaderTest, CacheAnswersOnlyTheSameInput) {
    write("main.comp", std::string(head) + "#include \"a.glsl\"\nvoid main() { if (a() == VALUE) return; }\n");
    write("a.glsl", "#if 0\n#include \"b.glsl\"\n#endif\nuint a() { return 1u; }\n");
    ShaderSource wanted = source();
    wanted.defines = {{"VALUE", "1u"}};
    const Spirv first = compileShader(wanted), again = compileShader(wanted);
    EXPECT_FALSE(first.cached);
    EXPECT_TRUE(again.cached);
    EXPECT_EQ(first.words, again.words);
    EXPECT_EQ(first.hash, again.hash);

    wanted.defines = {{"VALUE", "2u"}};
    EXPECT_FALSE(compileShader(wanted).cached);
    write("a.glsl", "#if 0\n#include \"b.glsl\"\n#endif\nuint a() { return 2u; }\n");
    EXPECT_FALSE(compileShader(wanted).cached);
    write("b.glsl", "");  // a file that appears changes what an #include line means
    EXPECT_FALSE(compileShader(wanted).cached);
    EXPECT_TRUE(compileShader(wanted).cached);
    std::filesystem::create_directories(folder_ / "shared");
    write("shared/b.glsl", "");  // one that is not found doesn't
    EXPECT_TRUE(compileShader(wanted).cached);
}

TEST_F(ShaderTest, DamagedCacheIsCompiledAgain) {
    write("main.comp", std::string(head) + "void main() {}\n");
    const Spirv good = compileShader(source());
    const Path cached = folder_ / "cache/spirv" / (good.hash.hex() + ".spv");
    ASSERT_TRUE(std::filesystem::exists(cached));
    std::string bytes = readText(cached);
    bytes[40] ^= 1;
    for (const std::string& damaged : {bytes, bytes.substr(0, 20), std::string()}) {
        writeFile(cached, damaged);
        const Spirv made = compileShader(source());
        EXPECT_FALSE(made.cached);
        EXPECT_EQ(made.words, good.words);
    }
}

TEST_F(ShaderTest, ThreadsCompileAtOnce) {
    constexpr std::size_t count = 12;
    for (std::size_t i = 0; i < count; ++i)
        write(fmt::format("{}.comp", i), fmt::format("{}void main() {{ for (uint i = 0; i < {}u; ++i); }}\n", head, i));
    std::vector<Spirv> made(count);
    parallelFor(count, 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) made[i] = compileShader(source(std::to_string(i) + ".comp"));
    });
    std::filesystem::remove_all(folder_ / "cache");
    for (std::size_t i = 0; i < count; ++i) EXPECT_EQ(made[i].words, compileShader(source(std::to_string(i) + ".comp")).words) << i;
}

TEST_F(ShaderTest, ClosureHashFollowsContentNotPlace) {
    write("a/x.h", "#include \"y.h\"\nstruct X { Y y; };\n");
    write("a/y.h", "struct Y { float f; };  // metres\n");
    write("b/x.h", "#include \"y.h\"\nstruct X { Y y; };\n");
    write("b/y.h", "struct Y { float f; };  // metres\n");
    const Hash a = includeClosure(folder_ / "a/x.h", {});
    EXPECT_EQ(a, includeClosure(folder_ / "b/x.h", {}));
    write("b/y.h", "struct Y { float f; };  // seconds\n");
    EXPECT_FALSE(a == includeClosure(folder_ / "b/x.h", {}));
}

}  // namespace
}  // namespace lodestir::gpu
