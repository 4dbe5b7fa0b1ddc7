// SPDX-License-Identifier: MIT
// results.jsonl: one line a measured frame. Lines are only ever added, whole, so that a killed study loses nothing that it has measured.
#pragma once
#include <framework/core/files.h>

#include <nlohmann/json.hpp>

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace lodestir {

struct PassCost {
    std::string name;
    double milliseconds = 0;
    std::map<std::string, std::uint64_t> rays;  ///< by purpose, all of them
};

/// What a technique with a budget was given to meet it.
struct BudgetMet {
    double budget = 0;    ///< milliseconds, or rays a pixel
    double reached = 0;   ///< when its knob was chosen; what the run took stands beside it
    bool inRange = true;  ///< false: no value of the knob costs so little, or so much
};

struct ResultRow {
    std::string run;  ///< hash of all that the frame depends on but the device
    std::string scene, technique;
    nlohmann::ordered_json knobs = nlohmann::ordered_json::object();
    std::uint32_t seed = 0;
    int offset = 0;  ///< frames after the event
    std::string device;
    double milliseconds = 0;  ///< on the device
    std::vector<PassCost> passes;
    std::map<std::string, double> counts;  ///< of the study's counters
    std::map<std::string, double> metrics;
    std::map<std::string, double> noise;  ///< of the reference, already taken out of the metrics named here
    std::map<std::string, double> deviation;  ///< of the reference: standard deviation that it gives all seeds' metrics named here alike
    double exposure = 1;                  ///< that the metrics were measured at
    std::optional<BudgetMet> budget;

    std::uint64_t rays() const;  ///< of all passes and purposes
};

/// One line's value. "frame" is counted from the event; passes and metrics look as in run.json.
nlohmann::ordered_json toJson(const ResultRow& row);
/// A line each.
std::string linesOf(const std::vector<ResultRow>& rows);
/// nlohmann's exceptions where a member is missing or of another kind.
ResultRow rowOf(const nlohmann::ordered_json& json);

/// Hands on the value of each whole line of all results*.jsonl files of a folder, files by name. Error with file and line where `take`
/// throws one of nlohmann's exceptions.
void readLines(const Path& folder, const std::function<void(const nlohmann::ordered_json& line)>& take);
/// The rows of all results*.jsonl files of a folder: each shard writes its own. A last line that was cut is passed over; of two rows of the
/// same run and frame the later one counts. Error with file and line where a whole line is none of ours.
std::vector<ResultRow> readResults(const Path& folder);

/// A results file open for adding to; a cut last line is dropped first.
class ResultFile {
public:
    explicit ResultFile(const Path& path);
    ~ResultFile();
    ResultFile(const ResultFile&) = delete;
    ResultFile& operator=(const ResultFile&) = delete;

    /// Adds lines with one write, on the disk when it returns. Error when the file cannot be written.
    void add(const std::string& lines);

private:
    Path path_;
    int handle_;
};

}  // namespace lodestir
