// SPDX-License-Identifier: MIT
// A study file as it was written: which techniques run on which scenes, what is measured, and what it is judged by. No GPU, no plugins.
#pragma once
#include <framework/core/files.h>
#include <framework/core/json.h>
#include <framework/graph/description.h>
#include <framework/study/error/outcomes.h>

#include <glm/glm.hpp>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace lodestir {

/// A parameter that takes the value of another.
struct Alike {
    std::string name, from;  ///< "pass.parameter"
    Where where;
};

/// A graph with changes, and the image port of it that is measured.
struct StudyGraph {
    Path graph;
    std::optional<std::string> variant;
    std::vector<Json> patches;  ///< merged into the graph behind the variant
    std::vector<Setting> set;
    std::vector<Alike> alike;
    std::string port;  ///< "pass.port"; empty: the shown port, or what is shown before tone mapping
    Where where;       ///< of the graph's name
    Where variantWhere, portWhere;
};

/// A parameter that takes several values.
struct Knob {
    std::string name;  ///< "pass.parameter"
    std::vector<Json> values;
};

/// A parameter whose value is looked for, so that a technique costs what the study's budget says.
struct SolvedKnob {
    std::string name;  ///< "pass.parameter"
    int low = 1, high = 1;
    Where where;
};

/// The count of nodes that rays visit, a pixel.
inline constexpr std::string_view stepsName = "steps";

/// A number that every frame of a technique has beside its time and rays.
struct Counter {
    std::string name;
    std::string port;  ///< "pass.port": a buffer of one uint or, as 64 bits with the low word first, of two
    Where where;
};

/// Which parts of a technique are taken away, each by itself, or also every two of them.
enum class Ablate { nothing, each, pairs };

/// A technique that is another one without some of its parts.
struct Ablation {
    std::size_t whole = 0;           ///< technique
    std::vector<std::string> parts;  ///< "pass" or "pass.parameter"
};

struct Technique {
    std::string name;
    StudyGraph graph;
    std::vector<Knob> vary;  ///< every combination is run; charts draw a curve along the last one
    std::vector<int> clear;    ///< frames after the event before which history is made void
    bool control = false;    ///< of an ensemble: known to be unbiased, so that blaming it blames the study
    bool planted = false;    ///< of an ensemble: known to be biased, to see it caught
    bool otherFilter = false;  ///< it may have another pixel filter than its reference
    std::optional<SolvedKnob> solve;   ///< where the study has a budget
    Ablate ablate = Ablate::nothing;
    std::optional<Ablation> ablation;  ///< what it is, where it was made by expandAblations()
};

/// A scene at one size of the image.
struct StudyScene {
    std::string name;  ///< of the file, without its ending; behind it the size, where the study has several
    Path file;
    Where where;
    glm::uvec2 size{480, 270};  ///< pixels

    double pixels() const { return double(size.x) * size.y; }
};

/// Pixels that errors are measured at besides those of the whole frame.
struct Mask {
    std::string name;
    std::optional<StudyGraph> graph;  ///< whose port says which, by values other than 0; none: where objects are seen that take another level from the event on
    bool optional = false;            ///< scenes in which nothing switches have no such mask, rather than being refused
};

/// One number that a measured frame is judged by.
struct Measure {
    std::string metric;
    std::string mask;     ///< only at the pixels of that name; empty: at all
    bool finest = false;  ///< against the scene at its finest levels, so that what a level loses counts too
    std::string name() const { return metric + (mask.empty() ? "" : "." + mask) + (finest ? ".finest" : ""); }
};

/// What every technique may cost.
struct Budget {
    enum class Kind { time, rays, steps };
    Kind kind = Kind::time;
    double value = 0;        ///< milliseconds a frame, or rays or steps a pixel
    std::string technique{};   ///< or what that one costs
    Where where{};
    std::string_view unit() const { return kind == Kind::time ? "ms" : kind == Kind::rays ? "rays a pixel" : "steps a pixel"; }
};

/// What a study asks: how large errors are, or whether the mean of many runs is right.
enum class StudyKind { error, ensemble };

struct Study {
    Path file;
    StudyKind kind = StudyKind::error;
    std::string about;
    std::vector<StudyScene> scenes;    ///< file by file, of each size by size
    std::vector<glm::uvec2> sizes;     ///< of each file, as the study has them
    std::vector<std::uint32_t> seeds;  ///< of an ensemble: one a run, in a row
    bool paired = false;       ///< every technique draws these seeds; else each draws its own, which these are moved to (drawnSeed())
    int warmup = 0;            ///< frames rendered before the event
    int event = 0;             ///< frame of the scene; where the file names none, `warmup`
    std::vector<int> measure;  ///< frames after the event (negative: before), rising
    StudyGraph reference;
    int referenceSamples = 0;  ///< a pixel, both halves together
    bool referenceExact = false;  ///< it has no noise, and is rendered once, frame by frame as the techniques are
    std::vector<Technique> techniques;
    std::vector<std::string> metrics, charts;  ///< none in an ensemble
    std::vector<Mask> masks;                   ///< errors there are measured beside those of the whole frame
    std::vector<Counter> counters;
    bool countSteps = false;                   ///< nodes that rays visit are a count, "steps", a pixel
    std::size_t baseline = 0;                  ///< technique that others are compared with
    std::optional<Budget> equal;               ///< that techniques with a knob to solve for are given
    bool decompose = false;                    ///< images of all runs are kept, and bias and variance told apart
    bool referenceFinest = false;              ///< errors against the finest levels are measured beside those against the levels shown
    std::optional<OutcomeRules> outcomes;      ///< which techniques hold in which of the scenes
    double halfWidth = 0.003;                  ///< of an ensemble: the widest 95 % half-width of the energy that it concludes from

    /// Does it conclude anything from how long frames take?
    bool judgesTime() const;
    /// Of all that is counted, in the order of tables.
    std::vector<std::string> countNames() const;
    bool isMeasured(int offset) const { return std::ranges::find(measure, offset) != measure.end(); }
};

/// Studies have seeds below this one, so that no technique ever shares its noise with a reference.
inline constexpr std::uint32_t firstReferenceSeed = 1u << 31;

/// An ensemble's reference is rendered in a multiple of so many batches, each a run of its own.
inline constexpr int referenceBatches = 64;

/// What a frame is judged by, in the order of tables.
std::vector<Measure> measuresOf(const Study& study);

/// Reads a study file; paths start from its folder. Throws Error with everything that is wrong with its form.
Study loadStudy(const Path& file);

}  // namespace lodestir
