// SPDX-License-Identifier: MIT
// The tutorials are followed to the letter, as a reader would, in an empty folder. If this fails, a newcomer's first hour does, too.
#include "markdown_page.h"
#include "program.h"

namespace lodestir::test {
namespace {

class Tutorials : public ProgramTest {
protected:
    /// With the build folder of this test in place of build/, which is what it is called in a reader's tree.
    void follow(const std::string& name, int byHand) {
        std::string page = readText(sourceFolder / name);
        const std::string ours = LODESTIR_BUILD_DIR;
        if (ours != sourceFolder / "build")
            for (const std::string usual : {"$PWD/build", "$LODESTIR/build"})
                for (std::size_t at = 0; (at = page.find(usual, at)) != page.npos; at += ours.size()) page.replace(at, usual.size(), ours);
        const Followed followed = followPage(page, name, sourceFolder, folder);
        for (const std::string& problem : followed.problems) ADD_FAILURE() << problem;
        EXPECT_EQ(followed.byHand, byHand) << name << ": commands that are left to the reader";
        EXPECT_GE(followed.commands, 10) << name;
        EXPECT_GE(followed.files, 3) << name;
        std::printf("%s: %d files, %d commands; by hand: %d; without a display left out: %d\n", name.c_str(), followed.files, followed.commands,
                    followed.byHand, followed.leftOut);
    }
    std::string problemOf(const std::string& page) {
        const Followed followed = followPage(page, "page.md", folder, folder);
        return followed.problems.empty() ? "" : followed.problems.front().substr(0, followed.problems.front().find('\n'));
    }
};

TEST_F(Tutorials, AddATechnique) { follow("docs/tutorial_technique.md", 1); }
TEST_F(Tutorials, ChooseLevels) { follow("docs/tutorial_levels.md", 1); }

// If these are not told, the two above prove nothing.
TEST_F(Tutorials, FaultsAreToldByPageAndLine) {
    EXPECT_EQ(problemOf("Make\n\n`a/b.txt`:\n\n```text\none $HOME\n```\n\n```sh\ncd a\ncat b.txt  # a comment\n```\n```text\n... one $HOME 12\n```\n"), "");
    EXPECT_EQ(problemOf("Text.\n\n```sh\ntrue\n" LODESTIR_BINARY " passes --no-such-option\n```\n").substr(0, 10), "page.md:5:");
    EXPECT_NE(problemOf("```sh\n" LODESTIR_BINARY " check none.json\n```\n").find("check none.json` ended with 1"), std::string::npos);
    EXPECT_EQ(problemOf("```sh\nexport WORD=something\n```\n```sh\necho \\\n  $WORD\n```\n```text\nsomething else\n```\n"),
              "page.md:9: \"else\" is promised, but what is printed is");
    EXPECT_EQ(problemOf("```sh\nexit 0\n```\n```sh\ntrue\n```\n").substr(0, 10), "page.md:5:") << "a page that ends early";
    EXPECT_EQ(problemOf("What is this?\n```json\n{}\n```\n"), "page.md:2: a block that is neither a file, nor commands, nor what they print");
    const Followed byHand = followPage("Then, by hand:\n```sh\nfalse\n```\n", "page.md", folder, folder);
    EXPECT_TRUE(byHand.problems.empty());
    EXPECT_EQ(byHand.byHand, 1);
}

}  // namespace
}  // namespace lodestir::test
