// SPDX-License-Identifier: MIT
// A folder for a test to write into.
#pragma once
#include <framework/core/files.h>

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>

namespace lodestir::test {

/// A folder that lives as long as this.
class TemporaryFolder {
public:
    TemporaryFolder() {
        std::string name = testing::TempDir() + "lodestir_XXXXXX";
        path = ::mkdtemp(name.data());
    }
    ~TemporaryFolder() { std::filesystem::remove_all(path); }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    Path path;
};

/// A folder of its own for each test.
class FolderTest : public testing::Test {
private:
    const TemporaryFolder temporary_;

protected:
    const Path& folder = temporary_.path;
};

}  // namespace lodestir::test
