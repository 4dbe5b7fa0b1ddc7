// SPDX-License-Identifier: MIT
// If pass.glsl and the block that the runner fills disagree by four bytes, every shader reads garbage addresses and the process dies.
#include "fake_passes.h"

#include <framework/gpu/shader.h>
#include <framework/graph/header.h>
#include <framework/shaders/base/frame.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <map>

namespace lodestir {
namespace {

/// One port of every kind and role, and one parameter of every type.
struct Everything final : Pass {
    enum class Curve { linear, filmic };
    In<Image>                 color{this, "color", "what comes in"};
    In<Image>                 mask{this, "mask", "where", Need::optional};
    In<Buffer<vec3>>          points{this, "points", "positions", Need::optional};
    In<Buffer<Ray>>           rays{this, "rays", "records of a shared struct"};
    In<World>                 world{this, "world", "the scene"};
    In<World>                 worldPrev{this, "worldPrev", "last frame's", Need::optional};
    Out<Image>                a{this, "a", "half floats", Format::r16f};
    Out<Image>                b{this, "b", "two half floats", Format::rg16f};
    Out<Image>                c{this, "c", "four half floats", Format::rgba16f};
    Out<Image>                d{this, "d", "a float", Format::r32f};
    Out<Image>                e{this, "e", "two floats", Format::rg32f};
    Out<Image>                f{this, "f", "four floats", Format::rgba32f};
    Out<Image>                g{this, "g", "bytes", Format::rgba8};
    Out<Image>                h{this, "h", "integers", Format::r32ui};
    Out<Buffer<Ray>>          made{this, "made", "records", Count::likePort("rays")};
    State<Image>              sum{this, "sum", "kept", Format::rgba32f};
    Scratch<Buffer<float>>    temporary{this, "temporary", "in between", Count::fixed(64)};
    Param<float>              knee{this, "knee", 0.5f, {0, 10}, "a float"};
    Const<int>                taps{this, "taps", 9, {1, 33}, "a constant"};
    Param<bool>               on{this, "on", true, "a bool"};
    Param<std::string>        note{this, "note", "x", "a text"};
    Param<Curve>              curve{this, "curve", Curve::filmic, {"linear", "filmic"}, "a choice"};
    Const<bool>               wide{this, "wide", false, "a constant bool"};
    Param<int>                count{this, "count", -3, {-5, 5}, "an int"};
};

/// Uses everything that pass.glsl gives for Everything.
constexpr const char* shader = R"(#version 460
#include "pass.glsl"
void main() {
    if (skip()) return;
    ivec2 p = pixel();
    vec4 value = colorRgba(p) + mask(p) + maskRgba(p) + sum(p);
    if (params.on && params.curve == curve_filmic) value *= params.knee + float(params.count) + float(taps);
    if (wide) value += vec4(colorSize(), maskSize());
    vec3 point = points(pixelIndex(p)) + world().sceneCenter + worldPrev().sceneCenter;
    Ray ray = rays(raysCount() - 1u);
    ray.origin += point * float(pointsCount());
#if HAS_mask || HAS_points || HAS_worldPrev
    ray.tMax = 1;
#endif
    storeMade(0u, ray);
    storeA(p, a(p) + value.x);
    storeB(p, b(p) + value.xy);
    storeC(p, c(p) + value);
    storeD(p, d(p) + value.x);
    storeE(p, e(p) + value.xy);
    storeF(p, f(p) + value);
    storeG(p, g(p) + value);
    storeH(p, h(p) + argument(2) + runSeed() + frameIndex() + frameSize().x);
    storeSum(p, historyValid() ? value : vec4(0));
    storeTemporary(3u, temporary(2u) + float(madeCount()));
    if (inside(p + 1)) countRays(RAYS_NEE, 2u);
}
)";

std::vector<PortBinding> bindings(const Pass& pass, bool optional, Format format) {
    std::vector<PortBinding> all;
    for (const Port* port : pass.ports) all.push_back({optional || !port->optional, port->isInput() ? format : port->format});
    return all;
}

gpu::Spirv compile(const Pass& pass, const std::vector<PortBinding>& bound, const std::string& text,
                   std::vector<std::pair<std::string, std::string>> defines = {}) {
    const Path file = Path(testing::TempDir()) / "header_test.comp";
    writeFile(file, text);
    return gpu::compileShader({.file = file,
                               .folders = {Path(LODESTIR_SOURCE_DIR) / "framework/shaders"},
                               .generated = {{"pass.glsl", passHeader(pass, "everything", bound)}},
                               .defines = std::move(defines)});
}

/// Offsets of the members of every struct in a module.
std::vector<std::vector<std::uint32_t>> structOffsets(const gpu::Spirv& spirv) {
    constexpr std::uint32_t memberDecorate = 72, offset = 35;
    std::map<std::uint32_t, std::map<std::uint32_t, std::uint32_t>> structs;
    for (std::size_t i = 5; i < spirv.words.size(); i += spirv.words[i] >> 16) {
        if ((spirv.words[i] & 0xffff) == memberDecorate && spirv.words[i + 3] == offset) structs[spirv.words[i + 1]][spirv.words[i + 2]] = spirv.words[i + 4];
    }
    std::vector<std::vector<std::uint32_t>> all;
    for (const auto& [id, members] : structs) {
        all.emplace_back();
        for (const auto& [member, at] : members) all.back().push_back(at);
    }
    return all;
}

bool contains(const std::vector<std::vector<std::uint32_t>>& all, const std::vector<std::size_t>& wanted) {
    return std::ranges::any_of(all, [&](const auto& offsets) { return std::ranges::equal(offsets, wanted); });
}

TEST(Header, CompilesForEveryFormatAndBinding) {
    const Everything pass;
    for (const Format format : {Format::r16f, Format::rg16f, Format::rgba16f, Format::r32f, Format::rg32f, Format::rgba32f, Format::rgba8, Format::r32ui}) {
        std::vector<PortBinding> bound = bindings(pass, true, format);
        bound[1].format = Format::rgba32f;  // the shader adds the mask as a vec4
        EXPECT_FALSE(compile(pass, bound, shader).words.empty()) << factsOf(format).name;
    }
    EXPECT_FALSE(compile(pass, bindings(pass, false, Format::rgba16f), shader).words.empty());
    EXPECT_FALSE(compile(pass, bindings(pass, false, Format::rgba16f), shader, {{"CHECK_BOUNDS", "1"}}).words.empty());
}

struct Counters {
    static constexpr std::string_view name = "Counters";
    static constexpr std::array members{bundled<uint>("hits", "how many"), bundled<float>("sums", "how much")};
};
struct CountsInABundle final : Pass {
    In<Counters>  counters{this, "counters", "before"};
    Out<Counters> countersOut{this, "counters", "after", Count::fixed(4)};
};

TEST(Header, MembersOfABundleAreCountedIn) {
    const CountsInABundle pass;
    const std::string text = R"(#version 460
#include "pass.glsl"
void main() {
    if (skip()) return;
    storeCountersSums(addCountersHits(1u, countersHits(0u)), madeCountersSums(2u) + countersSums(0u));
})";
    EXPECT_FALSE(compile(pass, bindings(pass, true, Format::rgba16f), text).words.empty());
}

struct Changed final : Pass {
    In<Image>         color{this, "color", "before"};
    In<Buffer<float>> list{this, "list", "before"};
    Out<Image>        colorOut{this, "color", "after", Format::rgba32f};
    Out<Buffer<float>> listOut{this, "list", "after", Count::perPixel()};
};

TEST(Header, AnOutputThatSharesItsNameIsReadAsMade) {
    const std::string text = R"(#version 460
#include "pass.glsl"
void main() {
    if (skip()) return;
    storeColor(pixel(), color(pixel()) + madeColor(pixel()) + vec4(colorSize(), madeColorSize()));
    storeList(0u, list(0u) + madeList(0u) + float(listCount() + madeListCount()));
}
)";
    const Changed pass;
    EXPECT_FALSE(compile(pass, bindings(pass, true, Format::rgba16f), text).words.empty());
}

TEST(Header, AMemberOfABundleIsReadByBothNames) {
    const fake::Drift pass;
    const std::string text = R"(#version 460
#include "pass.glsl"
void main() {
    if (skip()) return;
    uint i = pixelIndex(pixel());
    float mass = particlesMasses(i) + pastMasses(i) + madeParticlesMasses(i) + float(particlesPlacesCount() + pastMassesCount());
#if HAS_past
    mass += 1;
#endif
    storeBetweenPlaces(i, particlesPlaces(i));
    storeParticlesPlaces(i, betweenPlaces(i));
    storeParticlesMasses(i, mass);
}
)";
    for (const bool wired : {true, false}) EXPECT_FALSE(compile(pass, bindings(pass, wired, Format::rgba16f), text).words.empty()) << wired;
}

TEST(Header, ADriverOwnsTheLocalSize) {
    const Everything pass;
    const std::string driven =
        "#version 460\n#include \"pass.glsl\"\nlayout(local_size_x = 32) in;\nvoid main() { if (warming()) return; storeH(ivec2(0), 1u); }\n";
    EXPECT_FALSE(compile(pass, bindings(pass, true, Format::rgba16f), driven, {{"TRACE_DRIVER", "1"}}).words.empty());
}

TEST(Header, TheBlockLiesWhereTheShaderLooks) {
    const Everything pass;
    const BlockLayout layout = blockLayout(pass);
    const auto offsets = structOffsets(compile(pass, bindings(pass, true, Format::rgba32f), shader));
    EXPECT_TRUE(contains(offsets, {offsetof(FrameInfo, index), offsetof(FrameInfo, seed), offsetof(FrameInfo, size), offsetof(FrameInfo, historyValid),
                                   offsetof(FrameInfo, validate), offsetof(FrameInfo, salt), offsetof(FrameInfo, pad), offsetof(FrameInfo, ledger),
                                   offsetof(FrameInfo, faults)}));
    EXPECT_TRUE(contains(offsets, {offsetof(PortRecord, address), offsetof(PortRecord, size)}));
    EXPECT_TRUE(contains(offsets, {offsetof(Push, block), offsetof(Push, tileCounter), offsetof(Push, base), offsetof(Push, extent), offsetof(Push, arguments),
                                   offsetof(Push, warm), offsetof(Push, rows)}));
    const std::size_t first = *layout.parameters[0];  // knee: the first uniform
    std::vector<std::size_t> block{0}, params;
    block.insert(block.end(), layout.ports.begin(), layout.ports.end());
    block.push_back(first);
    for (const auto& at : layout.parameters) {
        if (at) params.push_back(*at - first);
    }
    EXPECT_TRUE(contains(offsets, block));
    EXPECT_TRUE(contains(offsets, params));
    EXPECT_EQ(params, (std::vector<std::size_t>{0, 4, 8, 12}));
    EXPECT_EQ(layout.bytes % 8, 0u);
    EXPECT_EQ(layout.constants[1], 1u);
    EXPECT_EQ(layout.constants[5], 5u);
    EXPECT_FALSE(layout.parameters[3] || layout.constants[3]) << "a text is for the pass alone";
}

TEST(Header, ParametersAreWrittenAsTheShaderReadsThem) {
    const Everything pass;
    const BlockLayout layout = blockLayout(pass);
    std::vector<std::byte> block(layout.bytes, std::byte{0xff});
    writeParameters(pass, layout, block);
    const auto word = [&](std::size_t parameter) {
        std::uint32_t bits = 0;
        std::memcpy(&bits, block.data() + *layout.parameters[parameter], sizeof bits);
        return bits;
    };
    EXPECT_EQ(word(0), 0x3f000000u);  // 0.5f
    EXPECT_EQ(word(2), 1u);
    EXPECT_EQ(word(4), 1u);
    EXPECT_EQ(word(6), 0xfffffffdu);  // -3
    EXPECT_EQ(bitsOf(pass.taps), 9u);
}

TEST(Header, SaysWhatEachThingIs) {
    const Everything pass;
    const std::string text = passHeader(pass, "everything", bindings(pass, false, Format::rgba16f));
    for (const char* part : {"// where (Image, unwired)\n#define HAS_mask 0", "// what comes in (rgba16f)\n#define HAS_color 1",
                             "// a constant (int 1..33)\nlayout(constant_id = 1) const int taps = 9;", "const int curve_filmic = 1;",
                             "float knee;  // a float (float 0..10)", "#include \"world/world.h\"", "World world()"}) {
        EXPECT_NE(text.find(part), std::string::npos) << part << " is not in\n" << text;
    }
    EXPECT_EQ(text.find("note"), std::string::npos);
    EXPECT_EQ(text.find("storeColor"), std::string::npos) << "inputs are read-only";
}

TEST(Header, TakesFormatsFromTheProducers) {
    fake::Workshop workshop;
    const Graph g = workshop.build(
        R"("r": {"type": "render"}, "q": {"type": "rate", "in": {"sum": "r.color"}}, "m": {"type": "mix", "in": {"a": "q", "b": "r.color"}})", "m");
    const Plan plan = makePlan(g);
    const std::vector<PortBinding> bound = bindingsOf(g, plan, g.find("m"));
    EXPECT_EQ(bound[0].format, Format::r16f);
    EXPECT_EQ(bound[1].format, Format::rgba16f);
    EXPECT_NE(passHeader(g, plan, g.find("m")).find("float a(ivec2 p)"), std::string::npos);
}

TEST(Header, CountsWorkgroups) {
    EXPECT_EQ(groupCount({17, 9}), glm::uvec2(3, 2));
    EXPECT_EQ(groupCount({65, 1}), glm::uvec2(2, 1));
    EXPECT_EQ(groupCount({8, 8}), glm::uvec2(1, 1));
}

TEST(Header, RefusesNamesThatShadersCannotUse) {
    struct Clash final : Pass {
        In<Image>    color{this, "color", ""};
        In<Image>    colorSize{this, "colorSize", ""};
        In<Image>    sample{this, "sample", ""};
        Out<Buffer<float>> again{this, "color", "", Count::perPixel()};
        Out<Image>   snake{this, "snake_case", "", Format::r16f};
        Param<float> pixel{this, "pixel", 0.0f, {0, 1}, ""};
    } clash;
    struct BundleClash final : Pass {
        In<fake::Particles> particles{this, "particles", ""};
        In<Image>           places{this, "particlesPlaces", ""};
        In<fake::Particles> sample{this, "sample", ""};
    } bundleClash;
    Problems problems;
    checkDeclaration(clash, "clash", {}, problems);
    checkDeclaration(bundleClash, "bundles", {}, problems);
    std::string said;
    for (const Problem& problem : problems.list()) said += problem.text() + "\n";
    EXPECT_EQ(said,
              "pass type \"clash\": port \"sample\" is a reserved word of GLSL; choose another name\n"
              "pass type \"clash\": port \"color\" is declared twice; ports and parameters share one set of names\n"
              "pass type \"clash\": port \"snake_case\" can't be a name in a shader; start with a small letter, then letters and digits\n"
              "pass type \"clash\": parameter \"pixel\" is a name that pass.glsl uses itself; choose another name\n"
              "pass type \"clash\": \"colorSize\" is what pass.glsl makes of port \"color\"; choose another name\n"
              "pass type \"clash\": \"colorSize\" is what pass.glsl makes of port \"color\"; choose another name\n"
              "pass type \"bundles\": port \"particlesPlaces\" is declared twice; ports and parameters share one set of names\n"
              "pass type \"bundles\": port \"sample\" is a reserved word of GLSL; choose another name\n");
}

}  // namespace
}  // namespace lodestir
