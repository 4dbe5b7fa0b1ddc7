// SPDX-License-Identifier: MIT
#include <framework/core/is_file.h>
#include <framework/core/log.h>
#include <framework/image/exr.h>
#include <framework/scene/deformation.h>
#include <framework/scene/level_policy.h>
#include <framework/study/content.h>
#include <framework/study/frame_cost.h>
#include <framework/study/measured_port.h>
#include <framework/study/pixel_filter.h>
#include <framework/study/stage.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstring>
#include <set>

namespace lodestir {
namespace {

constexpr std::uint32_t seedsPerHalf = 1u << 30;

ImageData colorOf(const ImageData& image, const std::string& name) {
    if (image.channels < 3) throw Error("the measured port " + name + " has no colour", "name one with \"port\"");
    return image.channels == 3 ? image : firstChannels(image, 3);
}

/// Puts a scene's policy of levels back in its place.
class PolicyKeeper {
public:
    explicit PolicyKeeper(Scene& scene) : scene_(scene), policy_(scene.lod) {}
    ~PolicyKeeper() { scene_.lod = policy_; }
    PolicyKeeper(const PolicyKeeper&) = delete;
    PolicyKeeper& operator=(const PolicyKeeper&) = delete;

private:
    Scene& scene_;
    LodPolicy policy_;
};

/// "trace.spp" of the one pass that has such a parameter; empty where none has, so that a frame is one sample.
std::string samplesParameter(const Graph& graph, const Where& where) {
    std::string name;
    for (const GraphNode& node : graph.nodes)
        if (!node.off && std::ranges::find(node.pass->parameters, "spp", &Parameter::name) != node.pass->parameters.end()) {
            if (!name.empty()) throw Error(where, "the reference has two passes with a parameter \"spp\"");
            name = node.name + ".spp";
        }
    return name;
}

Json placed(Json value, const Where& where) {
    value.moveTo(where);
    return value;
}

/// But for the frame that they belong to.
bool sameView(CameraKey a, const CameraKey& b) {
    a.frame = b.frame;
    return a == b;
}

/// The first measured frame at which the scene is as it is at `frame`, so that one reference serves for both.
int firstAlike(const Study& study, const Scene& scene, int frame) {
    const auto levels = [&](int at) { return scene.lod.mode == LodMode::finest ? std::vector<std::uint32_t>() : scheduledLevels(scene, float(at)); };
    for (const int offset : study.measure) {
        const int earlier = study.event + offset;
        if (earlier >= frame) break;
        if (sameView(scene.cameraAt(float(earlier)), scene.cameraAt(float(frame))) && poseAt(scene, float(earlier)) == poseAt(scene, float(frame)) &&
            levels(earlier) == levels(frame))
            return earlier;
    }
    return frame;
}

}  // namespace

Stage::Stage(const Study& study, const RendererOptions& options, std::shared_ptr<const gpu::Device> device)
    : study_(study), renderer_(options, std::move(device)) {}

Stage::~Stage() = default;

StagedGraph Stage::build(const StudyGraph& choice, const std::vector<Setting>& knobs, std::size_t scene, std::uint32_t seed) {
    GraphOptions options{.scene = std::filesystem::absolute(study_.scenes[scene].file),
                         .size = study_.scenes[scene].size,
                         .seed = seed,
                         .set = settingsOf(choice, knobs),
                         .variant = choice.variant,
                         .variantWhere = choice.variantWhere,
                         .patches = choice.patches};
    StagedGraph staged{.graph = renderer_.build(choice.graph, options)};
    staged.port = measuredPort(staged.graph, choice);
    const Port& port = staged.graph.port(staged.port);
    const Where& where = choice.port.empty() ? choice.where : choice.portWhere;
    if (port.type.kind != PortType::Kind::image)
        throw Error(where, "the measured port " + staged.graph.nameOf(staged.port) + " is no image", "name one with \"port\"");
    if (sizeOf(staged.graph, staged.port.node, staged.port.port, options.size.value()) != *options.size)
        throw Error(where, "the measured port " + staged.graph.nameOf(staged.port) + " is smaller than the frame",
                    "name another with \"port\"");
    return staged;
}

StagedGraph Stage::buildTechnique(const Technique& technique, const std::vector<Setting>& knobs, std::size_t scene, std::uint32_t seed) {
    StagedGraph staged = build(technique.graph, knobs, scene, seed);
    Problems problems;
    for (const Counter& counter : study_.counters) problems.attempt([&] { staged.counters.push_back(counterPort(staged.graph, counter)); });
    problems.raise();
    return staged;
}

void Stage::check() {
    Problems problems;
    std::vector<std::string> said;
    const auto attempt = [&](const auto& part) {
        try {
            part();
        } catch (const Error& error) {
            for (const Problem& problem : error.problems()) {
                if (std::ranges::find(said, problem.text()) != said.end()) continue;  // the same for each value and scene
                said.push_back(problem.text());
                problems.add(problem.where, problem.what, problem.hint);
            }
        }
    };
    std::set<PixelFilter> referenceFilters;
    for (std::size_t scene = 0; scene < study_.scenes.size(); ++scene)
        attempt([&] {
            const StagedGraph reference = build(study_.reference, {}, scene, 0);
            if (!study_.referenceExact && samplesParameter(reference.graph, study_.reference.where).empty() && study_.kind == StudyKind::ensemble)
                throw Error(study_.reference.where, "the reference has no pass with a parameter \"spp\"", "an ensemble's takes its samples in batches");
            referenceFilters = filtersOf(reference.graph, reference.port);
        });
    for (std::size_t scene = 0; scene < study_.scenes.size(); ++scene)
        for (const Mask& mask : study_.masks)
            if (mask.graph) attempt([&] { build(*mask.graph, {}, scene, 0); });
    for (std::size_t scene = 0; scene < study_.scenes.size(); ++scene)
        for (const Technique& technique : study_.techniques)
            for (auto& knobs : combinations(technique))
                attempt([&] {
                    if (technique.solve) knobs.push_back({technique.solve->name, placed(Json(technique.solve->high), technique.solve->where)});
                    const StagedGraph staged = buildTechnique(technique, knobs, scene, study_.seeds.front());
                    expectSameFilter(study_, technique, filtersOf(staged.graph, staged.port), referenceFilters);
                });
    problems.raise();
}

const Scene& Stage::scene(std::size_t index) {
    if (loaded_ != index) {
        loaded_.reset();
        runners_.clear();
        scene_ = loadScene(study_.scenes[index].file);
        content_ = lodestir::contentOf(scene_);
        loaded_ = index;
    }
    return scene_;
}

const Hash& Stage::sceneContent(std::size_t index) {
    scene(index);
    return content_;
}

std::string Stage::nameOf(const StudyRun& run) {
    const std::string key = configurationKey(run);
    const auto [place, isNew] = contents_.try_emplace(key);
    if (isNew) place->second = contentOf(run);
    return Hash(place->second).addValue(run.seed).hex();
}

/// Of a run but for its seed.
Hash Stage::contentOf(const StudyRun& run) {
    const StudyGraph& choice = study_.techniques[run.technique].graph;
    Hash hash;
    const auto add = [&](const StagedGraph& staged) { hash.addValue(lodestir::contentOf(staged.graph)).add(staged.graph.nameOf(staged.port)); };
    hash.addValue(sceneContent(run.scene));
    add(build(choice, run.knobs, run.scene, 0));
    add(build(study_.reference, {}, run.scene, 0));
    hash.addValue(study_.referenceSamples);
    if (needsSeen(study_)) hash.addValue(lodestir::contentOf(seenGraph(renderer_, study_.scenes[run.scene])));
    for (const Mask& mask : study_.masks)
        if (mask.graph) add(build(*mask.graph, {}, run.scene, 0));
    for (const Counter& counter : study_.counters) hash.add(counter.name + "\n" + counter.port + "\n");
    if (study_.countSteps) hash.add("steps\n");
    for (const int value : {study_.warmup, study_.event}) hash.addValue(value);
    for (const int offset : study_.measure) hash.addValue(offset);
    for (const Measure& measure : measuresOf(study_)) hash.add(measure.name() + "\n");
    for (const int offset : study_.techniques[run.technique].clear) hash.addValue(offset);
    return hash;
}

StagedGraph Stage::buildReference(std::size_t scene, int samples) {
    StagedGraph staged = build(study_.reference, {}, scene, 0);
    setParameter(staged.graph, samplesParameter(staged.graph, study_.reference.where), Json(samples));
    return staged;
}

std::unique_ptr<Runner> Stage::makeRunner(StagedGraph& staged, std::size_t index) {
    if (study_.countSteps && rays() == RayBody::rayQuery)
        throw Error(Where{study_.file.string()}, "steps are counted, which drivers don't tell of ray_query",
                    "trace with --rays lane, or remove \"countSteps\"");
    std::vector<Source> pinned = staged.counters;
    pinned.push_back(staged.port);
    return renderer_.bringUp(staged.graph, scene(index), {.pinned = std::move(pinned), .countSteps = study_.countSteps});
}

ImageData Stage::imageOf(const Runner& runner, const StagedGraph& staged) {
    ImageData image = colorOf(runner.readImage(staged.port), staged.graph.nameOf(staged.port));
    if (const auto& messages = renderer_.device().validationMessages(); !messages.empty()) throw Error("validation: " + messages.front());
    return image;
}

void Stage::runFrames(Runner& runner, const std::vector<int>& clear, const std::function<void(FrameReport&)>& take) {
    runner.setFrame(std::uint32_t(study_.event - study_.warmup));
    for (int offset = -study_.warmup; offset <= study_.measure.back(); ++offset) {
        if (std::ranges::find(clear, offset) != clear.end()) runner.reset();
        FrameReport report = runner.run();
        if (study_.isMeasured(offset)) take(report);
    }
}

std::vector<StagedFrame> Stage::render(const StudyRun& run) {
    const Technique& technique = study_.techniques[run.technique];
    scene(run.scene);  // a new one ends the runners of another
    const auto build = [&] { return buildTechnique(technique, run.knobs, run.scene, run.seed); };
    KeptRunner& kept = runners_.get(renderer_.device(), configurationKey(run), build,
                                    [&](StagedGraph& staged) { return makeRunner(staged, run.scene); });
    kept.staged.graph.description.seed = run.seed;
    std::vector<StagedFrame> frames;
    runFrames(*kept.runner, technique.clear, [&](FrameReport& report) {
        std::map<std::string, double> counts = countsOf(*kept.runner, kept.staged, report, run.scene);
        frames.push_back({std::move(report), imageOf(*kept.runner, kept.staged), std::move(counts)});
    });
    return frames;
}

std::map<std::string, double> Stage::countsOf(const Runner& runner, const StagedGraph& staged, const FrameReport& report, std::size_t scene) const {
    std::map<std::string, double> counts;
    for (std::size_t i = 0; i < staged.counters.size(); ++i) {
        const std::vector<std::byte> bytes = runner.readBytes(staged.counters[i]);
        std::uint64_t number = 0;
        std::memcpy(&number, bytes.data(), std::min(bytes.size(), sizeof number));
        counts[study_.counters[i].name] = double(number);
    }
    if (study_.countSteps) counts[std::string(stepsName)] = stepsOf(report) / study_.scenes[scene].pixels();
    return counts;
}

std::vector<ImageData> Stage::renderMask(const StudyGraph& graph, std::size_t scene) {
    StagedGraph staged = build(graph, {}, scene, study_.seeds.front());
    const std::unique_ptr<Runner> runner = makeRunner(staged, scene);
    std::vector<ImageData> images;
    runFrames(*runner, {}, [&](FrameReport&) { images.push_back(runner->readImage(staged.port)); });
    return images;
}

std::array<ReferenceHalf, 2> Stage::referenceHalves(std::size_t sceneIndex, int offset, const Path& folder, bool finest) {
    const Hash& sceneHash = sceneContent(sceneIndex);
    const PolicyKeeper policy(scene_);
    if (finest) scene_.lod.mode = LodMode::finest;
    const StagedGraph staged = build(study_.reference, {}, sceneIndex, 0);
    const int frame = study_.referenceExact ? study_.event + offset : firstAlike(study_, scene_, study_.event + offset);
    Hash content;
    content.addValue(sceneHash).addValue(lodestir::contentOf(staged.graph)).add(staged.graph.nameOf(staged.port));
    content.addValue(frame).addValue(study_.referenceSamples);
    if (finest) content.add("finest");
    const auto half = [&](std::uint32_t index) {
        return ReferenceHalf{sceneIndex, frame, finest, index, folder / (content.hex() + (study_.referenceExact ? ".exr" : index == 0 ? ".a.exr" : ".b.exr"))};
    };
    return {half(0), half(1)};
}

void Stage::makeHalf(const ReferenceHalf& half) {
    scene(half.scene);
    const PolicyKeeper policy(scene_);
    if (half.finest) scene_.lod.mode = LodMode::finest;
    StagedGraph staged = build(study_.reference, {}, half.scene, 0);
    const std::string attribute = staged.graph.resolved().dump(-1);
    writeExr(half.file, renderHalf(staged, half), {.attributes = {{"lodestir", attribute}}});
}

Seen Stage::see(std::size_t index) { return seeFrames(renderer_, study_, study_.scenes[index], scene(index)); }

int Stage::samplesAFrame(const Graph& graph) const {
    if (samplesParameter(graph, study_.reference.where).empty()) return 1;
    const auto pixels = std::uint64_t(graph.description.size.x) * graph.description.size.y;
    return std::min(study_.referenceSamples / 2, int(std::clamp<std::uint64_t>(samplesPerFrame / pixels, 1, 1024)));
}

/// Frames of one number and different seeds: every frame is a fresh start, so that nothing moves and none is weighted by history.
ImageData Stage::renderHalf(StagedGraph& staged, const ReferenceHalf& half) {
    if (study_.referenceExact) {
        const std::unique_ptr<Runner> runner = makeRunner(staged, half.scene);
        runner->setFrame(std::uint32_t(half.frame));
        runner->run();
        return firstChannels(imageOf(*runner, staged), 3);
    }
    const std::string samplesName = samplesParameter(staged.graph, study_.reference.where);
    const auto takeSamples = [&](int samples) {
        if (!samplesName.empty()) setParameter(staged.graph, samplesName, Json(samples));
    };
    takeSamples(samplesAFrame(staged.graph));
    const std::unique_ptr<Runner> runner = makeRunner(staged, half.scene);
    const int total = study_.referenceSamples / 2;
    const glm::uvec2 size = staged.graph.description.size;
    std::vector<double> sum(std::size_t(size.x) * size.y * 3);
    std::uint32_t seed = firstReferenceSeed + half.index * seedsPerHalf;
    log::Progress progress(fmt::format("reference of frame {}, half {}", half.frame, half.index == 0 ? "A" : "B"), std::size_t(total));
    std::optional<ImageData> first;
    for (int done = 0; done < total; ++seed) {
        const int samples = std::min(samplesAFrame(staged.graph), total - done);
        takeSamples(samples);
        staged.graph.description.seed = seed;
        runner->reset();
        runner->setFrame(std::uint32_t(half.frame));
        runner->run();
        ImageData image = imageOf(*runner, staged);
        if (first && samplesName.empty() && image.values == first->values)
            throw Error(study_.reference.where, "the reference is the same whatever the seed: there is nothing for its \"spp\" to average",
                        "say \"exact\": true instead, or let what pixels see be drawn by chance, as \"film\": \"random\" does");
        for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += double(image.values[i]) * samples / total;
        done += samples;
        progress.advance(std::size_t(samples));
        if (!first) first = std::move(image);
    }
    ImageData result = makeImage(int(size.x), int(size.y), 3);
    std::ranges::transform(sum, result.values.begin(), [](double value) { return float(value); });
    return result;
}

}  // namespace lodestir
