// SPDX-License-Identifier: MIT
// What a study renders: one run for each scene, technique, combination of knob values, and seed.
#pragma once
#include <framework/study/study_file.h>

#include <nlohmann/json_fwd.hpp>

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace lodestir {

struct StudyRun {
    std::size_t scene = 0, technique = 0;  ///< indices into the study
    std::vector<Setting> knobs;       ///< one of each of the technique's knobs
    std::uint32_t seed = 0;
};

/// Every combination of a technique's knob values, the last knob fastest.
std::vector<std::vector<Setting>> combinations(const Technique& technique);

/// What a graph's parameters are given: what is set, the knobs, and to those of "alike" the value of another one.
std::vector<Setting> settingsOf(const StudyGraph& choice, const std::vector<Setting>& knobs);

/// The seed that a technique with knob values draws for one of the study's. Paired, it is the study's own: differences between techniques can
/// be taken run by run, but what all of them show alike is one observation. Else it lies at a distance that follows from the technique's
/// name and knobs, below the seeds of references; without some of its parts a technique draws what the whole draws.
std::uint32_t drawnSeed(const Study& study, std::size_t technique, const std::vector<Setting>& knobs, std::uint32_t seed);

/// Scene by scene, so that each is loaded once; within a scene seed by seed, so that a machine that grows slow or busy slows all techniques alike.
std::vector<StudyRun> expandRuns(const Study& study);

/// {"trace.spp": 4}
nlohmann::ordered_json knobJson(const std::vector<Setting>& knobs);

/// "spp 4, mode fast": knobs without their passes; empty where there are none.
std::string knobText(std::span<const Setting> knobs);

/// "path tracing, spp 4"
std::string labelOf(const Study& study, std::size_t technique, std::span<const Setting> knobs);
/// Of a cell of a summary.
template <class Cell> std::string labelOf(const Study& study, const Cell& cell) { return labelOf(study, cell.technique, cell.knobs); }

/// What runs have in common that differ in their seed only.
std::string configurationKey(std::size_t scene, std::size_t technique, const std::vector<Setting>& knobs);
inline std::string configurationKey(const StudyRun& run) { return configurationKey(run.scene, run.technique, run.knobs); }

/// Every `count`th run, for several machines at work on one study.
struct Shard {
    std::size_t index = 1, count = 1;  ///< index counts from 1
    bool holds(std::size_t run) const { return run % count == index - 1; }
};
/// "2/8". Error when it is none.
Shard readShard(const std::string& text);

}  // namespace lodestir
