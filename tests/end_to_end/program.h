// SPDX-License-Identifier: MIT
// What tests of the whole program start from: a folder of their own, the program run in it with validation, its images and JSON read back.
#pragma once
#include "process.h"
#include "source_folder.h"

#include <framework/core/error.h>
#include <framework/core/files.h>
#include <framework/image/exr.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace lodestir::test {

using Arguments = std::vector<std::string>;

/// Real models for tests; the folder may be absent.
inline const Path assetFolder = (sourceFolder / "../shared/assets").lexically_normal();

inline std::string commandText(const Arguments& arguments) {
    std::string text;
    for (const std::string& argument : arguments) text += (text.empty() ? "" : " ") + argument;
    return text;
}

/// `lodestir` with these arguments, under the validation layers.
inline Output lodestir(const Arguments& arguments, std::chrono::duration<double> timeout = std::chrono::seconds(150)) {
    Arguments command{LODESTIR_BINARY};
    command.insert(command.end(), arguments.begin(), arguments.end());
    return runProcess(command, {{"LODESTIR_VALIDATION", "1"}}, timeout);
}

class ProgramTest : public testing::Test {
protected:
    ProgramTest() {
        std::string name = testing::TempDir() + "lodestir_end_to_end_XXXXXX";
        folder = ::mkdtemp(name.data());
    }
    ~ProgramTest() override {
        if (!HasFailure())
            std::filesystem::remove_all(folder);
        else
            std::printf("kept for a look: %s\n", folder.c_str());
    }

    void write(const Path& name, const OrderedJson& json) { writeFile(folder / name, json.dump(2)); }
    OrderedJson readJson(const Path& path) { return OrderedJson::parse(readText(path)); }
    /// The lines of a study's results.
    std::vector<OrderedJson> readRows(const Path& path) {
        std::vector<OrderedJson> rows;
        std::istringstream lines(readText(path));
        for (std::string line; std::getline(lines, line);) rows.push_back(OrderedJson::parse(line));
        return rows;
    }
    std::map<std::string, std::vector<OrderedJson>> readRowsByTechnique(const Path& path) {
        std::map<std::string, std::vector<OrderedJson>> rows;
        for (const OrderedJson& row : readRows(path)) rows[row["technique"]].push_back(row);
        return rows;
    }

    /// Runs a graph into folder/out; fails the test unless it ends well and validation is silent. Returns the folder.
    Path run(const std::string& out, const Path& graph, Arguments arguments) {
        arguments.insert(arguments.begin(), {"run", graph.string(), "--out", (folder / out).string()});
        const Output output = lodestir(arguments);
        EXPECT_EQ(output.exitCode, 0) << "lodestir " << commandText(arguments) << "\nsignal " << output.signal
                                      << (output.timedOut ? ", out of time" : "") << "\n"
                                      << output.err;
        EXPECT_EQ(output.err.find("validation"), std::string::npos) << output.err;
        return folder / out;
    }
    /// Names in a folder; none where there is no such folder.
    static std::set<std::string> filesOf(const Path& path) {
        std::set<std::string> names;
        std::error_code none;
        for (const auto& entry : std::filesystem::directory_iterator(path, none)) names.insert(entry.path().filename().string());
        return names;
    }

    Path folder;
};

inline bool allFinite(const ImageData& image) {
    return std::ranges::all_of(image.values, [](float v) { return std::isfinite(v); });
}
/// Mean over pixels and the colour channels.
inline double meanOf(const ImageData& image) {
    const ImageData color = image.channels == 4 ? firstChannels(image, 3) : image;
    double sum = 0;
    for (const float v : color.values) sum += v;
    return sum / static_cast<double>(color.values.size());
}

}  // namespace lodestir::test
