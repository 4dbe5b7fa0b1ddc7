// SPDX-License-Identifier: MIT
// What scripts rely on: names of files, keys of run.json, options, exit status, and that a failed run leaves nothing behind.
#include "program.h"

#include <framework/shaders/world/primary_hit.h>
#include <framework/shaders/world/world.h>

#include <cstring>

namespace lodestir::test {
namespace {

const Path pathTracer = sourceFolder / "graphs/path_tracer.json";
const Path visibility = sourceFolder / "passes/basic/visibility/visibility.json";
const Arguments small{"--scene", (sourceFolder / "scenes/cornell.json").string(), "--size", "64x48"};

Arguments with(Arguments first, const Arguments& rest) {
    first.insert(first.end(), rest.begin(), rest.end());
    return first;
}

std::vector<std::string> keysOf(const OrderedJson& object) {
    std::vector<std::string> keys;
    for (const auto& [key, value] : object.items()) keys.push_back(key);
    return keys;
}

class RunContract : public ProgramTest {};

TEST_F(RunContract, FilesAreNamedByShownPortAndFrame) {
    const Path out = run("out", pathTracer, with(small, {"--frames", "2", "--show", "trace.color", "--dump", "accumulate.mean"}));
    EXPECT_EQ(filesOf(out), (std::set<std::string>{"accumulate.mean.0.exr", "accumulate.mean.1.exr", "run.json", "trace.color.0.exr",
                                                   "trace.color.0.png", "trace.color.1.exr", "trace.color.1.png"}));
    const ImageData image = readExr(out / "trace.color.0.exr");
    EXPECT_EQ(image.width, 64);
    EXPECT_EQ(image.height, 48);
    EXPECT_TRUE(allFinite(image));
    EXPECT_GT(meanOf(image), 0.01);
    EXPECT_EQ(filesOf(run("pass", pathTracer, small)), (std::set<std::string>{"display.0.exr", "display.0.png", "run.json"}));
    EXPECT_EQ(filesOf(run("many", visibility, {"--size", "16x16", "--frames", "1", "--show", "hits.depth"})),
              (std::set<std::string>{"hits.depth.0.exr", "hits.depth.0.png", "run.json"}));
}

TEST_F(RunContract, RunJsonHasTheKeysOfTheContract) {
    const OrderedJson json =
        readJson(run("out", pathTracer, with(small, {"--frames", "2", "--seed", "7", "--set", "trace.spp=3"})) / "run.json");
    for (const char* key : {"lodestir", "graph", "device", "size", "seed", "frames", "setup", "memory"})
        EXPECT_TRUE(json.contains(key)) << key;
    EXPECT_TRUE(json["lodestir"].is_string());
    EXPECT_FALSE(json["device"]["name"].get<std::string>().empty());
    EXPECT_EQ(json["size"], OrderedJson::array({64, 48}));
    EXPECT_EQ(json["seed"], 7);
    ASSERT_EQ(json["frames"].size(), 2u);
    for (int i = 0; i < 2; ++i) {
        const OrderedJson& frame = json["frames"][std::size_t(i)];
        EXPECT_EQ(keysOf(frame), (std::vector<std::string>{"frame", "ms", "wholeMs", "passes", "metrics"}));
        EXPECT_EQ(frame["frame"], i);
        EXPECT_GT(frame["ms"], 0);
        for (const char* pass : {"trace", "accumulate", "display"}) {
            ASSERT_TRUE(frame["passes"].contains(pass)) << pass;
            EXPECT_GT(frame["passes"][pass]["ms"], 0);
            EXPECT_EQ(keysOf(frame["passes"][pass]["rays"]),
                      (std::vector<std::string>{"primary", "nee", "continue", "replay", "connect", "visibility"}));
        }
    }
    const OrderedJson& rays = json["frames"][0]["passes"]["trace"]["rays"];
    EXPECT_EQ(rays["primary"], 64 * 48 * 3) << "one a sample";
    EXPECT_GT(rays["nee"], 0);
    EXPECT_GT(rays["continue"], 0);
    EXPECT_LE(rays["nee"].get<int>(), 64 * 48 * 3 * 4) << "at most one at each of 4 scatterings";
    EXPECT_EQ(rays["replay"].get<int>() + rays["connect"].get<int>() + rays["visibility"].get<int>(), 0);
    EXPECT_EQ(json["frames"][0]["passes"]["display"]["rays"]["primary"], 0);

    // The graph in run.json is whole: defaults written out, what the command line changed taken in.
    EXPECT_EQ(json["graph"]["format"], 1);
    EXPECT_EQ(json["graph"]["passes"]["trace"]["set"]["spp"], 3);
    EXPECT_EQ(json["graph"]["passes"]["trace"]["set"]["roulette"], true);
    EXPECT_EQ(json["graph"]["frame"]["seed"], 7);
    EXPECT_EQ(json["graph"]["frame"]["size"], OrderedJson::array({64, 48}));
}

// If this fails, times are lost on their way out of the program: what a frame takes must be what its passes take, but for clearing and reading back.
TEST_F(RunContract, TheTraceCoversItsFrames) {
    const Path out = run("out", pathTracer, with(small, {"--frames", "3", "--set", "trace.spp=16", "--trace", (folder / "trace.json").string()}));
    const OrderedJson events = readJson(folder / "trace.json")["traceEvents"], frames = readJson(out / "run.json")["frames"];
    double end = 0, begin = 0, passes = 0;
    std::size_t frame = 0;
    for (const OrderedJson& event : events) {
        EXPECT_EQ(event["ph"], "X");
        const double start = event["ts"], length = event["dur"];
        if (event["tid"] == 0) {  // a frame, then its passes
            EXPECT_NEAR(start, end, 1e-3);
            EXPECT_NEAR(length, 1000 * frames.at(frame++)["wholeMs"].get<double>(), 1e-3);
            begin = start;
            end = start + length;
        } else {
            EXPECT_GE(start, begin - 1e-3);
            EXPECT_LE(start + length, end + 1e-3);
            passes += length;
        }
    }
    EXPECT_EQ(frame, 3u);
    EXPECT_GT(passes, 0.7 * end) << "most of the time is nobody's";
}

// If this fails, a picture can't be made again from what stands in it.
TEST_F(RunContract, TheGraphInAnImageMakesTheSameImageAgain) {
    const Path out =
        run("out", pathTracer, with(small, {"--frames", "2", "--seed", "3", "--set", "trace.spp=2", "--set", "display.exposure=1.5"}));
    const ExrFile first = readExrFile(out / "display.1.exr");
    ASSERT_TRUE(first.attributes.contains("lodestir"));
    writeFile(folder / "elsewhere/again.json", first.attributes.at("lodestir"));
    const Path again = run("again", folder / "elsewhere/again.json", {});
    const std::set<std::string> files = filesOf(again);  // a resolved graph may name the shown port in full
    const auto last = std::ranges::find_if(files, [](const std::string& name) { return name.ends_with(".1.exr"); });
    ASSERT_NE(last, files.end());
    const ExrFile second = readExrFile(again / *last);
    EXPECT_EQ(first.image.values, second.image.values);
    EXPECT_EQ(OrderedJson::parse(first.attributes.at("lodestir"))["passes"],
              OrderedJson::parse(second.attributes.at("lodestir"))["passes"]);
}

TEST_F(RunContract, BuffersAreDumpedAsStructuredArrays) {
    const Path out = run("out", visibility, {"--size", "40x24", "--dump", "hits.hits", "--frames", "1"});
    const std::string npy = readText(out / "hits.hits.0.npy");
    ASSERT_EQ(npy.substr(0, 6), "\x93NUMPY");
    for (const char* field : {"('instance', '<u4')", "('primitive', '<u4')", "('barycentrics', '<f4', (2,))", "('film', '<f4', (2,))"})
        EXPECT_NE(npy.substr(0, 1024).find(field), std::string::npos) << field;
    constexpr std::size_t bytes = 40 * 24 * sizeof(PrimaryHit);
    ASSERT_GT(npy.size(), bytes);
    std::vector<PrimaryHit> hits(40 * 24);
    std::memcpy(hits.data(), npy.data() + npy.size() - bytes, bytes);
    int hit = 0;
    for (std::size_t i = 0; i < hits.size(); ++i) {
        hit += hits[i].primitive != NONE;
        for (const float place : {hits[i].film.x, hits[i].film.y}) EXPECT_TRUE(place >= 0 && place < 1) << "pixel " << i << ": " << place;
    }
    EXPECT_GT(hit, 100);
}

TEST_F(RunContract, VariantsAndSettingsTakeEffect) {
    const auto rays = [&](const std::string& out, const Arguments& arguments) {
        const OrderedJson json = readJson(run(out, pathTracer, with(small, arguments)) / "run.json");
        return json["frames"][0]["passes"]["trace"]["rays"];
    };
    EXPECT_EQ(rays("bsdf", {"--variant", "BSDF sampling only"})["nee"], 0);
    EXPECT_EQ(rays("direct", {"--set", "trace.bounces=0"})["continue"], 0);
    const OrderedJson json = readJson(run("off", pathTracer, with(small, {"--variant", "no accumulation"})) / "run.json");
    EXPECT_FALSE(json["frames"][0]["passes"].contains("accumulate")) << "a pass that is off doesn't run";
}

// If this fails, noise isn't averaged away over frames.
TEST_F(RunContract, AccumulationIsTheMeanOfItsFrames) {
    const Path out = run("out", pathTracer, with(small, {"--frames", "3", "--show", "accumulate", "--dump", "trace.color"}));
    const ImageData mean = readExr(out / "accumulate.2.exr");
    ImageData sum = makeImage(mean.width, mean.height, mean.channels);
    for (int frame = 0; frame < 3; ++frame) {
        const ImageData one = readExr(out / ("trace.color." + std::to_string(frame) + ".exr"));
        for (std::size_t i = 0; i < sum.values.size(); ++i) sum.values[i] += one.values[i] / 3;
    }
    for (std::size_t i = 0; i < sum.values.size(); ++i) ASSERT_NEAR(mean.values[i], sum.values[i], 1e-5 + 1e-5 * sum.values[i]) << i;
}

TEST_F(RunContract, ReferenceGivesMetrics) {
    const Path first = run("first", pathTracer, small), reference = first / "display.0.exr";
    const OrderedJson same =
        readJson(run("same", pathTracer, with(small, {"--reference", reference.string()})) / "run.json")["frames"][0]["metrics"];
    const OrderedJson other = readJson(run("other", pathTracer, with(small, {"--seed", "2", "--reference", reference.string()})) /
                                       "run.json")["frames"][0]["metrics"];
    for (const char* metric : {"mse", "relmse", "mae"}) {
        ASSERT_TRUE(same.contains(metric)) << metric;
        EXPECT_EQ(same[metric], 0) << metric;
        EXPECT_GT(other[metric], 0) << metric;
    }
    // `compare` knows the same metrics and finds the same values.
    const std::string test = (folder / "other/display.0.exr").string();
    const Output all = lodestir({"compare", test, reference.string(), "--json"}),
                 some = lodestir({"compare", test, reference.string(), "--metrics", "relmse,mse", "--json"});
    ASSERT_EQ(all.exitCode + some.exitCode, 0) << all.err << some.err;
    EXPECT_EQ(OrderedJson::parse(some.out).size(), 2u);
    const OrderedJson metrics = OrderedJson::parse(all.out);
    EXPECT_GT(metrics.size(), other.size());
    EXPECT_EQ(keysOf(other), (std::vector<std::string>{"bias", "mae", "mse", "relmse"})) << "the cheap ones";
    const OrderedJson chosen = readJson(run("chosen", pathTracer, with(small, {"--seed", "2", "--reference", reference.string(), "--metrics", "flip,gmsd"})) /
                                        "run.json")["frames"][0]["metrics"];
    EXPECT_EQ(keysOf(chosen), (std::vector<std::string>{"flip", "gmsd"}));
    EXPECT_NEAR(chosen["flip"].get<double>(), metrics["flip"].get<double>(), 1e-6);
    EXPECT_NEAR(chosen["gmsd"].get<double>(), metrics["gmsd"].get<double>(), 1e-6);
    for (const auto& [name, value] : other.items())
        EXPECT_NEAR(value.get<double>(), metrics[name].get<double>(), 1e-6 * std::abs(value.get<double>())) << name;
}

TEST_F(RunContract, WrongUseEndsWithTwo) {
    const std::string graph = pathTracer.string();
    for (const Arguments& arguments : {Arguments{},
                                       {"fly"},
                                       {"run"},
                                       {"run", graph, "--no-such-option"},
                                       {"run", graph, "--size", "64"},
                                       {"run", graph, "--size", "0x5"},
                                       {"run", graph, "--frames", "0"},
                                       {"run", graph, "--frames", "many"},
                                       {"run", graph, "--seed", ""},
                                       {"run", graph, "--seed", "-1"},
                                       {"run", graph, "--rays", ""},
                                       {"run", graph, "--reference", ""},
                                       {"run", graph, "--scene", ""},
                                       {"compare", "one.exr"}}) {
        const Output output = lodestir(arguments);
        EXPECT_EQ(output.exitCode, 2) << "lodestir " << commandText(arguments) << "\n" << output.err;
        EXPECT_FALSE(output.err.empty()) << commandText(arguments);
    }
}

TEST_F(RunContract, HelpEndsWithZero) {
    EXPECT_EQ(lodestir({"--help"}).exitCode, 0);
    for (const char* command : {"run", "compare", "passes", "check", "scene", "devices"}) {
        const Output output = lodestir({command, "--help"});
        EXPECT_EQ(output.exitCode, 0) << command;
        EXPECT_NE(output.out.find("--help"), std::string::npos) << command;
    }
}

// If this fails, a reader takes the scene's own choice of levels for what the graph shows.
TEST_F(RunContract, CheckSaysWhoChoosesLevels) {
    const auto levels = [&](const char* graph) {
        return OrderedJson::parse(lodestir({"check", sourceFolder / graph, "--json"}).out)["levels"].get<std::string>();
    };
    EXPECT_EQ(levels("graphs/restir_pt.json").find("passes read"), std::string::npos);
    EXPECT_NE(levels("graphs/stochastic_lod.json").find("lod (lod_select)"), std::string::npos);
}

// If this fails, a script takes what a failed run left for a result.
TEST_F(RunContract, FailuresEndWithOneAndLeaveNothing) {
    const std::string graph = pathTracer.string(), out = (folder / "out").string();
    write("bad.json", {{"format", 1},
                       {"scene", "nowhere.json"},
                       {"passes", {{"trace", {{"type", "path_trcer"}, {"set", {{"spp", 1}}}}}}},
                       {"show", "trace"}});
    const ImageData tiny = makeImage(3, 3, 3);
    writeExr(folder / "tiny.exr", tiny);
    struct Case {
        Arguments arguments;
        std::string message;
    };
    const std::vector<Case> cases{
        {{"run", (folder / "none.json").string()}, "none.json"},
        {{"run", (folder / "bad.json").string()}, "bad.json:6:15: no pass type \"path_trcer\""},
        {{"run", graph, "--variant", "no such"}, "no such"},
        {{"run", graph, "--set", "trace.sp=4"}, "spp"},
        {{"run", graph, "--set", "trace.spp=0"}, "1..4096"},
        {{"run", graph, "--show", "trace.colour"}, "color"},
        {{"run", graph, "--dump", "trac.color"}, "trace"},
        {{"run", graph, "--scene", (folder / "no.gltf").string()}, "no.gltf"},
        {{"run", graph, "--passes", (folder / "nothing").string()}, "nothing"},
        {{"run", graph, "--device", "no such device"}, "no such device"},
        {{"run", graph, "--rays", "spiral"}, "spiral"},
        {with({"run", graph, "--reference", (folder / "tiny.exr").string()}, small), "3 x 3"},
        {with({"run", graph, "--reference", (folder / "none.exr").string()}, small), "none.exr"},
    };
    for (const Case& c : cases) {
        Arguments arguments = c.arguments;
        arguments.insert(arguments.end(), {"--out", out});
        const Output output = lodestir(arguments);
        EXPECT_EQ(output.exitCode, 1) << "lodestir " << commandText(arguments) << "\n" << output.err;
        EXPECT_NE(output.err.find(c.message), std::string::npos) << "expected \"" << c.message << "\" in\n" << output.err;
        EXPECT_TRUE(filesOf(out).empty()) << commandText(arguments) << " left " << *filesOf(out).begin();
    }
    const std::string tinyName = (folder / "tiny.exr").string();
    Arguments blocked = with({"run", graph, "--out", tinyName}, small);
    const Output output = lodestir(blocked);
    EXPECT_EQ(output.exitCode, 1) << output.err;
    EXPECT_NE(output.err.find("tiny.exr"), std::string::npos) << output.err;
    EXPECT_EQ(readExr(folder / "tiny.exr").width, 3);
    const Output full = runProcess({"sh", "-c", std::string(LODESTIR_BINARY) + " compare --json " + tinyName + " " + tinyName + " >/dev/full"});
    EXPECT_EQ(full.exitCode, 1) << "the disk that took the facts was full";
    EXPECT_NE(full.err.find("what was printed cannot be written"), std::string::npos) << full.err;
}

TEST_F(RunContract, BatchCommandsTouchNoDisplay) {
    Arguments arguments{LODESTIR_BINARY, "run", pathTracer.string(), "--out", (folder / "out").string()};
    arguments = with(arguments, small);
    const Output output = runProcess(arguments, {{"LODESTIR_VALIDATION", "1"}, {"DISPLAY", ":987"}, {"WAYLAND_DISPLAY", "nothing"}});
    EXPECT_EQ(output.exitCode, 0) << output.err;
}

}  // namespace
}  // namespace lodestir::test
