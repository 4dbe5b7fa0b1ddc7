// SPDX-License-Identifier: MIT
// Small passes that exist in tests only: one for each thing a graph can ask of a pass. They never run.
#pragma once
#include <framework/graph/graph.h>

#include <array>
#include <string>
#include <vector>

namespace lodestir {

/// A struct that passes hand on, as they do World.
struct Tally {
    uint count;
};

}  // namespace lodestir
LODESTIR_SHARED(Tally, "")
template <> inline constexpr bool lodestir::isChained<lodestir::Tally> = true;

namespace lodestir::fake {

struct SceneNode final : Pass {
    Out<World> world{this, "world", "the scene"};
};
struct LodSelect final : Pass {
    enum class Mode { finest, distance, schedule };
    In<World>   scene{this, "scene", "the scene, any levels"};
    Out<World>  world{this, "world", "the scene with the chosen levels"};
    Param<Mode> mode{this, "mode", Mode::finest, {"finest", "distance", "schedule"}, "how levels are chosen"};
    PassThrough bypass{this, scene, world};
};
struct Render final : Pass {
    In<World>         world{this, "world", "what is seen"};
    Out<Image>        color{this, "color", "radiance", Format::rgba16f};
    Out<Buffer<vec4>> values{this, "values", "a value of each pixel", Count::perPixel(2)};
    Param<float>      gain{this, "gain", 0.1f, {0, 10}, "multiplies the radiance"};
    Param<bool>       sky{this, "sky", true, "the sky shines"};
    Param<std::string> note{this, "note", "", "a text that no shader sees"};
};
struct Blur final : Pass {
    In<Image>   color{this, "color", "what is blurred"};
    In<Image>   mask{this, "mask", "where to blur", Need::optional};
    Out<Image>  glow{this, "glow", "blurred", Format::rgba16f, {.like = "color"}};
    Param<int>  radius{this, "radius", 8, {1, 16}, "half-width, pixels"};
    Const<int>  taps{this, "taps", 9, {1, 33}, "samples per axis"};
    PassThrough bypass{this, color, glow};
};
/// Makes its result in the place of what it takes, and a second one on request.
struct Grade final : Pass {
    In<Image>  color{this, "color", "what is graded"};
    Out<Image> graded{this, "graded", "the same, graded", Format::rgba16f};
    Out<Image> change{this, "change", "by how much", Format::rg16f, Need::optional};
    InPlace    over{this, color, graded};
};
struct Half final : Pass {
    In<Image>  color{this, "color", "full size"};
    Out<Image> small{this, "small", "half size", Format::rgba16f, {.scale = 0.5f}};
};
struct Temporal final : Pass {
    In<Image>  color{this, "color", "this frame"};
    In<Image>  past{this, "past", "last frame's result"};
    Out<Image> result{this, "result", "mixed", Format::rgba16f};
};
struct Accumulate final : Pass {
    In<Image>    color{this, "color", "one sample"};
    State<Image> sum{this, "sum", "sum of all frames", Format::rgba32f};
    Out<Image>   mean{this, "mean", "average of all frames", Format::rgba32f};
    Accumulate() { restartOnChange = true; }
};
struct Rate final : Pass {
    In<Image>  sum{this, "sum", "what was accumulated"};
    Out<Image> rate{this, "rate", "samples to take", Format::r16f};
};
struct Bake final : Pass {
    Out<Buffer<float>> table{this, "table", "a thousand numbers", Count::fixed(1000)};
    Bake() { cadence = Cadence::onChange; }
};
struct Lookup final : Pass {
    In<Image>             color{this, "color", "what is looked up"};
    In<Buffer<float>>     table{this, "table", "in which table"};
    Scratch<Buffer<uint>> counts{this, "counts", "in between", Count::likePort("table")};
    Out<Image>            found{this, "found", "what was found", Format::rg16f};
};
struct Values final : Pass {
    In<Buffer<vec4>>  values{this, "values", "a value of each pixel"};
    Out<Buffer<vec4>> sorted{this, "sorted", "the same in order", Count::likePort("values")};
};
struct Huge final : Pass {
    Out<Buffer<vec4>> values{this, "values", "many values of each pixel", Count::perPixel(20)};
};
struct ToneMap final : Pass {
    In<Image>  color{this, "color", "radiance"};
    Out<Image> image{this, "image", "what is displayed", Format::rgba8, {.like = "color"}};
};
struct Motion final : Pass {
    In<World>  world{this, "world", "this frame"};
    In<World>  worldPrev{this, "worldPrev", "last frame"};
    In<World>  other{this, "other", "another world", Need::optional};
    Out<Image> motion{this, "motion", "pixels", Format::rg16f};
};
struct Mix final : Pass {
    In<Image>  a{this, "a", "first"};
    In<Image>  b{this, "b", "second"};
    Out<Image> sum{this, "sum", "both", Format::rgba16f};
};
struct Sharpen final : Pass {
    In<Image>   color{this, "color", "what comes in"};
    Out<Image>  colorOut{this, "color", "the same, sharper", Format::rgba16f};
    PassThrough bypass{this, color, colorOut};
};
struct AgreeOn final : Pass {
    Out<Ray> agreed{this, "agreed", "a struct of its own"};
};
struct Follow final : Pass {
    In<Ray>    agreed{this, "agreed", "what others agreed on"};
    Out<Image> image{this, "image", "made by it", Format::rgba16f};
};
/// A bundle of the tests' own, and one that claims its name.
struct Particles {
    static constexpr std::string_view name = "Particles";
    static constexpr std::array members{bundled<vec4>("places", "where each is"), bundled<float>("masses", "how heavy")};
};
struct OtherParticles {
    static constexpr std::string_view name = "Particles";
    static constexpr std::array members{bundled<vec4>("places", "where each is")};
};
struct Emit final : Pass {
    Out<Particles> particles{this, "particles", "new ones", Count::fixed(300)};
    Out<Image>     light{this, "light", "that they send", Format::rgba16f};
    Out<Image>     smoke{this, "smoke", "that they leave", Format::rgba16f};
};
struct Drift final : Pass {
    In<Particles>      particles{this, "particles", "before"};
    In<Particles>      past{this, "past", "last frame's", Need::optional};
    Out<Particles>     particlesOut{this, "particles", "after", Count::likePort("particles")};
    Scratch<Particles> between{this, "between", "in between", Count::likePort("past")};
    PassThrough        bypass{this, particles, particlesOut};
};
struct Weigh final : Pass {
    In<Buffer<float>> masses{this, "masses", "how heavy each is"};
    Out<Image>        sum{this, "sum", "how heavy all are", Format::r32f};
};
struct CountOthers final : Pass {
    In<OtherParticles> particles{this, "particles", "of another kind"};
    Out<Image>         count{this, "count", "how many", Format::r32f};
};
struct StartTally final : Pass {
    Out<Tally> tally{this, "tally", "nothing counted"};
};
struct AddToTally final : Pass {
    In<Tally>  tally{this, "tally", "so far"};
    Out<Tally> tallyOut{this, "tally", "with one more"};
};
struct ShowTally final : Pass {
    In<Tally>  tally{this, "tally", "in the end"};
    In<Tally>  tallyPrev{this, "tallyPrev", "last frame's"};
    Out<Image> image{this, "image", "of both", Format::r32f};
};
struct BadNames final : Pass {
    In<Image>  input{this, "input", "a reserved word"};
    Out<Image> pixel{this, "pixel", "a name of pass.glsl", Format::rgba16f, {.like = "nobody"}};
    Param<int> color{this, "2color", 40, {1, 16}, "a bad name and a bad default"};
};

template <class T> Plugin plugin(const char* type) {
    return {"test", type, "fake.comp", "A pass of the tests.", __FILE__, []() -> Pass* { return new T; }, nullptr};
}

inline void addTo(PluginLibraries& libraries) {
    libraries.addBuiltIn("scene", plugin<SceneNode>("SceneNode"));
    libraries.addBuiltIn("lod_select", plugin<LodSelect>("LodSelect"));
    libraries.addBuiltIn("render", plugin<Render>("Render"));
    libraries.addBuiltIn("blur", plugin<Blur>("Blur"));
    libraries.addBuiltIn("grade", plugin<Grade>("Grade"));
    libraries.addBuiltIn("half", plugin<Half>("Half"));
    libraries.addBuiltIn("temporal", plugin<Temporal>("Temporal"));
    libraries.addBuiltIn("accumulate", plugin<Accumulate>("Accumulate"));
    libraries.addBuiltIn("rate", plugin<Rate>("Rate"));
    libraries.addBuiltIn("bake", plugin<Bake>("Bake"));
    libraries.addBuiltIn("lookup", plugin<Lookup>("Lookup"));
    libraries.addBuiltIn("values", plugin<Values>("Values"));
    libraries.addBuiltIn("huge", plugin<Huge>("Huge"));
    libraries.addBuiltIn("tone_map", plugin<ToneMap>("ToneMap"));
    libraries.addBuiltIn("motion", plugin<Motion>("Motion"));
    libraries.addBuiltIn("mix", plugin<Mix>("Mix"));
    libraries.addBuiltIn("sharpen", plugin<Sharpen>("Sharpen"));
    libraries.addBuiltIn("agree_on", plugin<AgreeOn>("AgreeOn"));
    libraries.addBuiltIn("follow", plugin<Follow>("Follow"));
    libraries.addBuiltIn("emit", plugin<Emit>("Emit"));
    libraries.addBuiltIn("drift", plugin<Drift>("Drift"));
    libraries.addBuiltIn("weigh", plugin<Weigh>("Weigh"));
    libraries.addBuiltIn("count_others", plugin<CountOthers>("CountOthers"));
    libraries.addBuiltIn("start_tally", plugin<StartTally>("StartTally"));
    libraries.addBuiltIn("add_to_tally", plugin<AddToTally>("AddToTally"));
    libraries.addBuiltIn("show_tally", plugin<ShowTally>("ShowTally"));
    libraries.addBuiltIn("bad_names", plugin<BadNames>("BadNames"));
}

/// A graph from the text of its "passes"; names the fake libraries for as long as the test lives.
class Workshop {
public:
    Workshop() { addTo(libraries_); }
    Graph build(const std::string& passes, const std::string& show, const GraphOptions& options = {}) {
        const std::string text = "{\"format\": 1, \"frame\": {\"size\": [100, 60]}, \"passes\": {" + passes + "}, \"show\": \"" + show + "\"}";
        return buildGraph(readDescription(Json::parse(text, "test.json"), "test.json", options), libraries_);
    }
    PluginLibraries& libraries() { return libraries_; }

private:
    PluginLibraries libraries_;
};

}  // namespace lodestir::fake
