// SPDX-License-Identifier: MIT
#include <framework/study/report/report.h>

#include <framework/core/log.h>

#include <nlohmann/json.hpp>

#include <array>
#include <cerrno>
#include <optional>

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

namespace lodestir {
namespace {

/// scripts/ lies beside graphs/, in the source tree as in an install prefix.
Path programFolder() { return graphFolder().parent_path() / "scripts/report"; }

/// Exit code of scripts/report, which says itself what went wrong; nothing where there is no Python.
std::optional<int> draw(const Path& out) {
    std::string program = programFolder().string(), folder = std::filesystem::absolute(out).string();
    std::string python = "python3", quiet = "--quiet";
    const std::array<char*, 5> arguments{python.data(), program.data(), folder.data(), quiet.data(), nullptr};
    pid_t child = 0;
    if (::posix_spawnp(&child, python.c_str(), nullptr, nullptr, arguments.data(), environ) != 0) return {};
    int status = 0;
    while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {}
    return WIFEXITED(status) ? WEXITSTATUS(status) : 1;
}

}  // namespace

std::vector<std::string> chartNames() {
    return {"error_vs_time",   "error_vs_rays", "error_vs_frame", "time_vs_frame", "frontier",      "time_by_pass",
            "rays_by_pass",    "rays_by_purpose", "stability",    "comparison",    "ablation",      "bias_variance",
            "stability_matrix", "error_vs_count", "needs",        "advantage",     "cost_vs_model", "outcomes"};
}

void writeReport(const Path& out, const nlohmann::ordered_json& summary) {
    writeFile(out / "summary.json", summary.dump(1) + "\n");
    const std::optional<int> code = draw(out);
    if (code == 0) {
        log::note("{}", (out / "report.html").string());
        return;
    }
    if (!code) log::warn("there is no python3 to draw the report with; install it, then run python3 {} {}", programFolder().string(), out.string());
    log::note("{}", (out / "summary.json").string());
}

}  // namespace lodestir
