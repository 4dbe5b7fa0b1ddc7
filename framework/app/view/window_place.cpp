// SPDX-License-Identifier: MIT
#include <framework/app/view/window_place.h>

#include <framework/core/files.h>
#include <framework/core/log.h>

#include <nlohmann/json.hpp>

#include <cstdlib>
#include <exception>
#include <string>

namespace lodestir {
namespace {

/// Empty where this user has no place for it.
Path file() {
    const char* state = std::getenv("XDG_STATE_HOME");
    const char* home = std::getenv("HOME");
    if (state && Path(state).is_absolute()) return Path(state) / "lodestir/window.json";
    return home && Path(home).is_absolute() ? Path(home) / ".local/state/lodestir/window.json" : Path();
}

}  // namespace

std::optional<WindowPlace> readWindowPlace() {
    std::error_code none;
    if (file().empty() || !std::filesystem::exists(file(), none)) return {};
    try {
        const auto json = nlohmann::json::parse(readText(file()));
        const auto pair = [&](const char* name) { return glm::ivec2(json.at(name).at(0).get<int>(), json.at(name).at(1).get<int>()); };
        WindowPlace place{pair("corner"), pair("size"), json.at("maximised").get<bool>()};
        const bool usable = glm::all(glm::greaterThanEqual(place.size, glm::ivec2(160))) && glm::all(glm::lessThanEqual(place.size, glm::ivec2(16384)));
        return usable ? std::optional(place) : std::nullopt;
    } catch (const std::exception&) {
        return {};  // unreadable or damaged: the window opens as if for the first time, and is remembered again
    }
}

void keepWindowPlace(const WindowPlace& place) {
    if (file().empty()) return;
    try {
        std::filesystem::create_directories(file().parent_path());
        const nlohmann::ordered_json json{
            {"corner", {place.corner.x, place.corner.y}}, {"size", {place.size.x, place.size.y}}, {"maximised", place.maximised}};
        writeFile(file(), json.dump() + "\n");
    } catch (const std::exception& problem) {
        log::note("the window's place isn't remembered: {}", problem.what());
    }
}

}  // namespace lodestir
