// SPDX-License-Identifier: MIT
#include <framework/core/error.h>
#include <framework/study/results.h>

#include <algorithm>
#include <cerrno>
#include <fcntl.h>
#include <limits>
#include <system_error>
#include <unistd.h>

namespace lodestir {
namespace {

using OrderedJson = nlohmann::ordered_json;

[[noreturn]] void fail(const Path& path, int reason) {
    throw Error(Where{path.string()}, "cannot be written: " + std::generic_category().message(reason));
}

/// JSON has no NaN: it is written as null.
double numberOf(const OrderedJson& json) { return json.is_null() ? std::numeric_limits<double>::quiet_NaN() : json.get<double>(); }

void readFile(const Path& path, const std::function<void(const OrderedJson&)>& take) {
    const std::string text = readText(path);
    int line = 1;
    for (std::size_t begin = 0, end; (end = text.find('\n', begin)) != text.npos; begin = end + 1, ++line) {
        try {
            take(OrderedJson::parse(text.begin() + std::ptrdiff_t(begin), text.begin() + std::ptrdiff_t(end)));
        } catch (const OrderedJson::exception&) {
            throw Error(Where{path.string(), line}, "is no row of results", "remove the line; its run will be made again");
        }
    }
}

}  // namespace

std::uint64_t ResultRow::rays() const {
    std::uint64_t sum = 0;
    for (const PassCost& pass : passes)
        for (const auto& [purpose, count] : pass.rays) sum += count;
    return sum;
}

OrderedJson toJson(const ResultRow& row) {
    OrderedJson costs = OrderedJson::object();
    for (const PassCost& pass : row.passes) costs[pass.name] = {{"ms", pass.milliseconds}, {"rays", pass.rays}};
    OrderedJson json{{"scene", row.scene},
            {"technique", row.technique},
            {"knobs", row.knobs},
            {"seed", row.seed},
            {"frame", row.offset},
            {"ms", row.milliseconds},
            {"passes", std::move(costs)},
            {"counts", row.counts},
            {"metrics", row.metrics},
            {"referenceNoise", row.noise},
            {"referenceDeviation", row.deviation},
            {"exposure", row.exposure},
            {"device", row.device},
            {"run", row.run}};
    if (row.budget) json["budget"] = {{"value", row.budget->budget}, {"reached", row.budget->reached}, {"inRange", row.budget->inRange}};
    return json;
}

ResultRow rowOf(const OrderedJson& json) {
    ResultRow row{.run = json.at("run"),
                  .scene = json.at("scene"),
                  .technique = json.at("technique"),
                  .knobs = json.at("knobs"),
                  .seed = json.at("seed"),
                  .offset = json.at("frame"),
                  .device = json.at("device"),
                  .milliseconds = numberOf(json.at("ms"))};
    for (const auto& [name, cost] : json.at("passes").items())
        row.passes.push_back({name, numberOf(cost.at("ms")), cost.at("rays").get<std::map<std::string, std::uint64_t>>()});
    if (json.contains("counts"))  // rows of earlier versions have none
        for (const auto& [name, value] : json.at("counts").items()) row.counts[name] = numberOf(value);
    for (const auto& [name, value] : json.at("metrics").items()) row.metrics[name] = numberOf(value);
    for (const auto& [name, value] : json.at("referenceNoise").items()) row.noise[name] = numberOf(value);
    if (json.contains("referenceDeviation"))  // rows of earlier versions have none
        for (const auto& [name, value] : json.at("referenceDeviation").items()) row.deviation[name] = numberOf(value);
    row.exposure = numberOf(json.at("exposure"));
    if (json.contains("budget")) {
        const OrderedJson& budget = json.at("budget");
        row.budget = BudgetMet{budget.at("value"), budget.at("reached"), budget.at("inRange")};
    }
    return row;
}

void readLines(const Path& folder, const std::function<void(const OrderedJson&)>& take) {
    std::vector<Path> files;
    std::error_code none;
    for (const auto& entry : std::filesystem::directory_iterator(folder, none)) {
        const std::string name = entry.path().filename().string();
        if (name.starts_with("results") && name.ends_with(".jsonl")) files.push_back(entry.path());
    }
    std::ranges::sort(files);
    for (const Path& file : files) readFile(file, take);
}

std::string linesOf(const std::vector<ResultRow>& rows) {
    std::string lines;
    for (const ResultRow& row : rows) lines += toJson(row).dump() + "\n";
    return lines;
}

std::vector<ResultRow> readResults(const Path& folder) {
    std::vector<ResultRow> all, rows;
    readLines(folder, [&](const OrderedJson& line) { all.push_back(rowOf(line)); });
    std::map<std::pair<std::string, int>, std::size_t> places;
    for (ResultRow& row : all) {
        const auto [place, isNew] = places.emplace(std::pair(row.run, row.offset), rows.size());
        if (isNew)
            rows.push_back(std::move(row));
        else
            rows[place->second] = std::move(row);
    }
    return rows;
}

ResultFile::ResultFile(const Path& path) : path_(path), handle_(-1) {
    std::error_code failure;
    if (path.has_parent_path()) std::filesystem::create_directories(path.parent_path(), failure);
    if (failure) throw Error(Where{path.parent_path().string()}, "the folder cannot be made: " + failure.message());
    if (std::filesystem::exists(path, failure)) {
        const std::string text = readText(path);
        const std::size_t last = text.rfind('\n'), whole = last == text.npos ? 0 : last + 1;
        if (whole != text.size()) std::filesystem::resize_file(path, whole, failure);
        if (failure) throw Error(Where{path.string()}, "cannot be written: " + failure.message());
    }
    handle_ = ::open(path.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
    if (handle_ < 0) fail(path, errno);
}

ResultFile::~ResultFile() { ::close(handle_); }

void ResultFile::add(const std::string& lines) {
    for (std::size_t written = 0; written < lines.size();) {
        const ssize_t count = ::write(handle_, lines.data() + written, lines.size() - written);
        if (count < 0 && errno != EINTR) fail(path_, errno);
        if (count > 0) written += std::size_t(count);
    }
    if (::fsync(handle_) != 0 && errno != EINVAL) fail(path_, errno);
}

}  // namespace lodestir
