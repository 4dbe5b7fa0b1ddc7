// SPDX-License-Identifier: MIT
// Changes of files: in place, by renaming over, of size alone, of time alone; and a file that is gone for a while.
#include "../temporary_folder.h"

#include <framework/core/file_watch.h>

#include <gtest/gtest.h>

#include <chrono>
#include <unistd.h>

namespace lodestir {
namespace {

class FileWatchTest : public test::FolderTest {
protected:
    FileWatchTest() {
        a = folder / "a.glsl";
        b = folder / "b.glsl";
        writeFile(a, "one");
        writeFile(b, "two");
        watch.watch({a, b});
    }
    /// A later time than the last one, whatever the file system's steps.
    void touch(const Path& file) { std::filesystem::last_write_time(file, std::filesystem::file_time_type::clock::now() + std::chrono::seconds(++seconds)); }

    Path a, b;
    FileWatch watch;
    int seconds = 0;
};

using Files = std::vector<Path>;

TEST_F(FileWatchTest, NothingChangedNothingSaid) { EXPECT_EQ(watch.changed(), Files{}); }

TEST_F(FileWatchTest, AChangeIsSaidOnce) {
    writeFile(a, "longer");
    EXPECT_EQ(watch.changed(), Files{a});
    EXPECT_EQ(watch.changed(), Files{});
}

TEST_F(FileWatchTest, TimeAloneCounts) {
    touch(b);
    EXPECT_EQ(watch.changed(), Files{b});
}

TEST_F(FileWatchTest, AFileThatIsGoneCountsWhenItIsBack) {
    std::filesystem::remove(a);
    EXPECT_EQ(watch.changed(), Files{});
    writeFile(a, "again");
    EXPECT_EQ(watch.changed(), Files{a});
}

TEST_F(FileWatchTest, AFileThatIsNotThereYet) {
    const Path later = folder / "later.glsl";
    watch.watch({a, later});
    EXPECT_EQ(watch.changed(), Files{});
    writeFile(later, "here");
    EXPECT_EQ(watch.changed(), Files{later});
}

TEST_F(FileWatchTest, WatchingAnewLosesNoChange) {
    writeFile(a, "changed before");
    watch.watch({a});
    EXPECT_EQ(watch.size(), 1u);
    touch(b);  // no longer watched
    EXPECT_EQ(watch.changed(), Files{a});
}

}  // namespace
}  // namespace lodestir
