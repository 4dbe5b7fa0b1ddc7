// SPDX-License-Identifier: MIT
// Reading, writing aside, hashing, and where folders lie.
#include "../environment_variable.h"
#include "../temporary_folder.h"

#include <framework/core/error.h>
#include <framework/core/files.h>
#include <framework/core/is_file.h>

#include <gtest/gtest.h>

#include <bit>
#include <csignal>
#include <cstdlib>
#include <set>
#include <sys/resource.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

namespace lodestir {
namespace {

namespace fs = std::filesystem;
using test::EnvironmentVariable;

class Files : public test::FolderTest {
protected:
    std::size_t fileCount() const { return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), {})); }
};

template <class Call> std::string refusal(Call call) {
    try {
        call();
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

TEST_F(Files, RoundTripsBytesAndMakesFolders) {
    std::string content(100000, '\0');
    for (std::size_t i = 0; i < content.size(); ++i) content[i] = static_cast<char>(i * 31);
    writeFile(folder / "a/b/c.bin", content);
    EXPECT_EQ(readText(folder / "a/b/c.bin"), content);
    EXPECT_EQ(readBytes(folder / "a/b/c.bin").size(), content.size());
    writeFile(folder / "a/b/c.bin", std::string_view());
    EXPECT_EQ(readText(folder / "a/b/c.bin"), "");
}

TEST_F(Files, ReadsFilesThatDoNotKnowTheirSize) { EXPECT_GT(readText("/proc/self/status").size(), 100u); }

TEST_F(Files, ErrorsNameTheFileAndTheReason) {
    EXPECT_EQ(refusal([&] { readText(folder / "none"); }), (folder / "none").string() + ": cannot be read: No such file or directory");
    EXPECT_EQ(refusal([&] { readBytes(folder); }), folder.string() + ": cannot be read: Is a directory");
    EXPECT_EQ(refusal([&] { writeFile(folder, std::string_view("x")); }), folder.string() + ": cannot be written: it is a folder");
    writeFile(folder / "file", std::string_view("x"));
    EXPECT_EQ(refusal([&] { writeFile(folder / "file/inside", std::string_view("x")); }),
              (folder / "file").string() + ": the folder cannot be made: Not a directory");
}

// If this fails, a checkout without large files ends in an error about broken models and images.
TEST_F(Files, GitLfsPointersAreNamed) {
    const std::string pointer = "version https://git-lfs.github.com/spec/v1\noid sha256:0\nsize 12\n";
    writeFile(folder / "m.glb", pointer);
    EXPECT_EQ(refusal([&] { readBytes(folder / "m.glb"); }),
              (folder / "m.glb").string() + ": is a git-lfs pointer, not the file itself; fetch with git lfs pull");
}

// If this fails, a killed study leaves half a result file in place of the whole one it had.
TEST_F(Files, AKilledWriterLeavesTheOldFile) {
    const Path path = folder / "results.jsonl";
    writeFile(path, std::string_view("old"));
    const pid_t child = ::fork();
    if (child == 0) {
        writeAside(path, [](const Path& aside) {
            std::FILE* file = std::fopen(aside.c_str(), "wb");
            std::fputs("half of the new conten", file);
            std::fflush(file);
            ::kill(::getpid(), SIGKILL);
        });
    }
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    ASSERT_TRUE(WIFSIGNALED(status));
    EXPECT_EQ(readText(path), "old");
    writeFile(path, std::string_view("new"));  // what the killed one left doesn't stand in the way
    EXPECT_EQ(readText(path), "new");
}

// If this fails, a full disk gives half a file, a scrap beside it, or no word about it.
TEST_F(Files, AFullDiskLeavesTheOldFileAndNothingElse) {
    const Path path = folder / "results.jsonl";
    writeFile(path, std::string_view("old"));
    const pid_t child = ::fork();
    if (child == 0) {
        const ::rlimit limit{1000, 1000};  // as good as full: no file may grow further
        ::setrlimit(RLIMIT_FSIZE, &limit);
        ::signal(SIGXFSZ, SIG_IGN);
        const std::string said = refusal([&] { writeFile(path, std::string(100'000, 'x')); });
        ::_exit(said == path.string() + ": cannot be written: File too large" ? 0 : 1);
    }
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << "no or another message";
    EXPECT_EQ(readText(path), "old");
    EXPECT_EQ(fileCount(), 1u);
}

// If this fails, each kill in the middle of a large file leaves its scrap on the disk for ever.
TEST_F(Files, AKilledWriterLeavesNoScrap) {
    const Path path = folder / "image.exr";
    for (int round = 0; round < 8; ++round) {
        const pid_t child = ::fork();
        if (child == 0) {
            const std::string content(8 << 20, 'x');
            for (;;) writeFile(path, content);
        }
        ::usleep(static_cast<::useconds_t>(10'000 + 3'701 * round));
        ::kill(child, SIGKILL);
        ::waitpid(child, nullptr, 0);
    }
    const bool isThere = fs::exists(path);
    EXPECT_TRUE(!isThere || fs::file_size(path) == 8 << 20);
    EXPECT_LE(fileCount(), isThere ? 2u : 1u);  // killed between a name and its exchange, two calls apart, they leave one between them
    writeFile(path, std::string_view("new"));
    EXPECT_EQ(readText(path), "new");
    EXPECT_EQ(fileCount(), 1u);
}

TEST_F(Files, NamesThatNobodyCanHaveAreNoFiles) {
    fs::create_symlink(folder / "b", folder / "a");
    fs::create_symlink(folder / "a", folder / "b");
    EXPECT_FALSE(isFile(folder / "a"));
    EXPECT_FALSE(isFile(folder / std::string(300, 'a')));
    EXPECT_FALSE(isFile(folder));
    EXPECT_EQ(refusal([&] { readText(""); }), "a file without a name cannot be read");
    writeFile(folder / "a", std::string_view("new"));
    EXPECT_EQ(readText(folder / "a"), "new");
}

TEST_F(Files, AFailedWriteLeavesTheOldFileAndNothingElse) {
    const Path path = folder / "image.exr";
    writeFile(path, std::string_view("old"));
    EXPECT_THROW(writeAside(path,
                            [&](const Path& aside) {
                                EXPECT_EQ(aside.extension(), ".exr");
                                EXPECT_EQ(aside.parent_path(), folder);
                                throw Error("no");
                            }),
                 Error);
    EXPECT_EQ(readText(path), "old");
    EXPECT_EQ(fileCount(), 1u);
}

TEST_F(Files, WritersOfOneFileDoNotMeet) {
    {
        std::vector<std::jthread> writers;
        for (char c = 'a'; c < 'i'; ++c) {
            writers.emplace_back([this, c] {
                for (int i = 0; i < 20; ++i) writeFile(folder / "x", std::string(5000, c));
            });
        }
    }
    const std::string content = readText(folder / "x");
    EXPECT_EQ(content, std::string(5000, content[0])) << "a mixture of two writers";
    EXPECT_EQ(fileCount(), 1u);
}

TEST_F(Files, LinksAndDevicesSurvive) {
    writeFile(folder / "target", std::string_view("old"));
    fs::create_symlink(folder / "target", folder / "link");
    writeFile(folder / "link", std::string_view("new"));
    EXPECT_TRUE(fs::is_symlink(folder / "link"));
    EXPECT_EQ(readText(folder / "target"), "new");
    writeFile("/dev/null", std::string_view("nothing"));
    EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

// If this fails, every cache on every machine is lost (or, worse, a change of the hash goes unnoticed).
TEST(Hash, IsStable) {
    EXPECT_EQ(Hash().hex(), "9e3779b97f4a7c15c2b2ae3d27d4eb4f");
    EXPECT_EQ(Hash().add("").hex(), "7234d1fca8e426add90699345768d3ca");
    EXPECT_EQ(Hash().add("lodestir").hex(), "51f3ec8bd22cca228d91d28dbd8dae23");
    EXPECT_EQ(Hash().add("a").addValue(std::uint32_t{7}).hex(), "008fcfb3f7fabe51cc583368ae601706");
}

TEST(Hash, TellsContentsApart) {
    EXPECT_EQ(Hash().add("ab").add("c"), Hash().add("ab").add("c"));
    EXPECT_NE(Hash().add("ab").add("c"), Hash().add("a").add("bc"));
    EXPECT_NE(Hash().add("a").add("b"), Hash().add("b").add("a"));
    std::set<std::string> seen;
    for (std::size_t zeros = 0; zeros < 40; ++zeros) seen.insert(Hash().add(std::string(zeros, '\0')).hex());
    for (int bit = 0; bit < 4096; ++bit) {
        std::string content(512, 'x');
        content[static_cast<std::size_t>(bit / 8)] ^= static_cast<char>(1 << bit % 8);
        seen.insert(Hash().add(content).hex());
    }
    EXPECT_EQ(seen.size(), 40u + 4096u);
}

// A good hash changes half of its bits with each bit of the input: 64 of 128, standard deviation 5.7. The mean over 4096 flips has 0.09.
TEST(Hash, EachBitChangesHalfOfThem) {
    const std::string content(64, 'x');
    const Hash plain = Hash().add(content);
    double changed = 0;
    for (int bit = 0; bit < 512; ++bit) {
        std::string flipped = content;
        flipped[static_cast<std::size_t>(bit / 8)] ^= static_cast<char>(1 << bit % 8);
        const Hash other = Hash().add(flipped);
        const int count = std::popcount(plain.a ^ other.a) + std::popcount(plain.b ^ other.b);
        EXPECT_GT(count, 30) << bit;  // six standard deviations
        changed += count / 512.0;
    }
    EXPECT_NEAR(changed, 64, 1.5);
}

TEST_F(Files, SealedOnesAreReadWholeOrNotAtAll) {
    const Path file = folder / "deep/sealed.bin";
    EXPECT_FALSE(readSealed(file));
    std::vector<std::byte> content(1001);
    for (std::size_t i = 0; i < content.size(); ++i) content[i] = std::byte(i * 7);
    writeSealed(file, content);
    EXPECT_EQ(readSealed(file), content);
    const std::vector<std::byte> whole = readBytes(file);
    for (const std::size_t size : {std::size_t(0), std::size_t(7), sizeof(Hash), whole.size() - 1}) {
        writeFile(file, std::span(whole).first(size));
        EXPECT_FALSE(readSealed(file)) << size;
    }
    for (const std::size_t place : {std::size_t(0), sizeof(Hash), whole.size() - 1}) {
        std::vector<std::byte> damaged = whole;
        damaged[place] ^= std::byte(16);
        writeFile(file, damaged);
        EXPECT_FALSE(readSealed(file)) << place;
    }
    writeSealed(file, {});
    EXPECT_EQ(readSealed(file), std::vector<std::byte>());
}

// If this fails, files written on Windows name nothing, or a name that really has a backslash means another file.
TEST_F(Files, BackslashesAreSlashesWhereNothingHasTheName) {
    writeFile(folder / "sub/a.txt", std::string_view("a"));
    writeFile(folder / "sub/b.txt", std::string_view("b"));
    writeFile(folder / "sub\\b.txt", std::string_view("b, with a backslash"));
    EXPECT_EQ(namedPath(folder, "sub/a.txt"), folder / "sub/a.txt");
    EXPECT_EQ(namedPath(folder, "sub\\a.txt"), folder / "sub/a.txt");
    EXPECT_EQ(namedPath(folder / "sub", "..\\sub\\a.txt"), folder / "sub/../sub/a.txt");
    EXPECT_EQ(namedPath("elsewhere", (folder / "sub\\a.txt").string()), folder / "sub/a.txt");
    EXPECT_EQ(namedPath(folder, "sub\\b.txt"), folder / "sub\\b.txt");
    EXPECT_EQ(namedPath(folder, "sub\\c.txt"), folder / "sub\\c.txt") << "what is said to be missing is the name as it was written";
}

TEST_F(Files, TheCacheLiesWhereTheUserSays) {
    {
        const EnvironmentVariable chosen("LODESTIR_CACHE", (folder / "mine").c_str());
        EXPECT_EQ(cacheFolder("bvh"), folder / "mine/bvh");
        EXPECT_TRUE(fs::is_directory(folder / "mine/bvh"));
    }
    const EnvironmentVariable unset("LODESTIR_CACHE", nullptr);
    const EnvironmentVariable xdg("XDG_CACHE_HOME", (folder / "xdg").c_str());
    EXPECT_EQ(cacheFolder("bvh"), folder / "xdg/lodestir/bvh");
    const EnvironmentVariable relative("XDG_CACHE_HOME", "not/absolute");  // the XDG specification says to ignore it
    const EnvironmentVariable home("HOME", (folder / "home").c_str());
    EXPECT_EQ(cacheFolder("bvh"), folder / "home/.cache/lodestir/bvh");
    const EnvironmentVariable broken("HOME", "/proc/nowhere");
    EXPECT_EQ(cacheFolder("bvh").filename(), "bvh");
    EXPECT_TRUE(fs::is_directory(cacheFolder("bvh")));
    const EnvironmentVariable wrong("LODESTIR_CACHE", "/proc/nowhere");
    EXPECT_NE(refusal([] { cacheFolder("bvh"); }).find("check LODESTIR_CACHE"), std::string::npos);
}

TEST_F(Files, ShadersComeFromTheSourceTreeUnlessTheUserSays) {
    const EnvironmentVariable unset("LODESTIR_SHADERS", nullptr);
    EXPECT_EQ(shaderFolder(), Path(LODESTIR_SOURCE_DIR) / "framework/shaders");
    const EnvironmentVariable chosen("LODESTIR_SHADERS", folder.c_str());
    EXPECT_EQ(shaderFolder(), folder);
}

}  // namespace
}  // namespace lodestir
