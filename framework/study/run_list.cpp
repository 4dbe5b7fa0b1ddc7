// SPDX-License-Identifier: MIT
#include <framework/study/run_list.h>

#include <framework/core/files.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <charconv>

namespace lodestir {
std::vector<std::vector<Setting>> combinations(const Technique& technique) {
    std::vector<std::vector<Setting>> all{{}};
    for (const Knob& knob : technique.vary) {
        std::vector<std::vector<Setting>> longer;
        for (const auto& combination : all)
            for (const Json& value : knob.values) {
                longer.push_back(combination);
                longer.back().push_back({knob.name, value});
            }
        all = std::move(longer);
    }
    return all;
}

std::vector<Setting> settingsOf(const StudyGraph& choice, const std::vector<Setting>& knobs) {
    std::vector<Setting> settings = choice.set;
    settings.insert(settings.end(), knobs.begin(), knobs.end());
    const std::size_t given = settings.size();
    for (const Alike& alike : choice.alike)
        for (std::size_t i = 0; i < given; ++i)
            if (settings[i].name == alike.from) {
                settings.push_back({alike.name, settings[i].value});
                settings.back().value.moveTo(alike.where);  // what is wrong with it here is no fault of the other
            }
    return settings;
}

std::vector<StudyRun> expandRuns(const Study& study) {
    std::vector<StudyRun> runs;
    for (std::size_t scene = 0; scene < study.scenes.size(); ++scene)
        for (const std::uint32_t seed : study.seeds)
            for (std::size_t technique = 0; technique < study.techniques.size(); ++technique)
                for (auto& knobs : combinations(study.techniques[technique])) {
                    const std::uint32_t drawn = drawnSeed(study, technique, knobs, seed);
                    runs.push_back({scene, technique, std::move(knobs), drawn});
                }
    return runs;
}

std::uint32_t drawnSeed(const Study& study, std::size_t technique, const std::vector<Setting>& knobs, std::uint32_t seed) {
    if (study.paired) return seed;
    const auto& ablation = study.techniques[technique].ablation;
    const std::size_t drawing = ablation ? ablation->whole : technique;
    const Hash place = Hash().add(study.techniques[drawing].name + "\n" + knobJson(knobs).dump());
    return (seed + std::uint32_t(place.a)) % firstReferenceSeed;
}

nlohmann::ordered_json knobJson(const std::vector<Setting>& knobs) {
    nlohmann::ordered_json json = nlohmann::ordered_json::object();
    for (const Setting& knob : knobs) json[knob.name] = knob.value.plain();
    return json;
}

std::string knobText(std::span<const Setting> knobs) {
    std::string text;
    for (const Setting& knob : knobs)
        text += fmt::format("{}{} {}", text.empty() ? "" : ", ", knob.name.substr(knob.name.find('.') + 1),
                            knob.value.isString() ? knob.value.asString() : knob.value.dump(-1));
    return text;
}

std::string labelOf(const Study& study, std::size_t technique, std::span<const Setting> knobs) {
    return study.techniques[technique].name + (knobs.empty() ? "" : ", " + knobText(knobs));
}

std::string configurationKey(std::size_t scene, std::size_t technique, const std::vector<Setting>& knobs) {
    return fmt::format("{} {} {}", scene, technique, knobJson(knobs).dump());
}

Shard readShard(const std::string& text) {
    Shard shard;
    const char* end = text.data() + text.size();
    const auto [slash, good] = std::from_chars(text.data(), end, shard.index);
    if (good == std::errc() && slash != end && *slash == '/') {
        const auto [rest, also] = std::from_chars(slash + 1, end, shard.count);
        if (also == std::errc() && rest == end && shard.index >= 1 && shard.index <= shard.count) return shard;
    }
    throw Error("\"" + text + "\" is no shard", "write 1/4, 2/4, 3/4 and 4/4 for the four parts of a study");
}

}  // namespace lodestir
