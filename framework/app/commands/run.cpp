// SPDX-License-Identifier: MIT
// `lodestir run`: renders a graph's frames without a display and writes images, dumps and run.json.
#include <framework/app/commands/commands.h>

#include <framework/app/command_line.h>
#include <framework/app/dump.h>
#include <framework/app/interrupt.h>
#include <framework/app/metric_option.h>
#include <framework/app/run_report.h>
#include <framework/app/validators.h>
#include <framework/core/log.h>
#include <framework/image/exr.h>
#include <framework/image/image_file.h>
#include <framework/image/metrics.h>
#include <framework/image/png.h>
#include <framework/image/preview.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <memory>

namespace lodestir {
namespace {

struct RunOptions {
    SessionOptions session;
    Path out = "out";
    Path trace;
    Path reference;
    std::vector<std::string> metrics{"mse", "relmse", "mae", "bias"};  ///< none takes longer than writing the image
    bool checkNan = false, lastOnly = false, json = false;
};

void requireFinite(const ImageData& image, const std::string& name) {
    std::size_t bad = 0, first = 0;
    for (std::size_t i = image.values.size(); i-- > 0;)
        if (!std::isfinite(image.values[i])) {
            ++bad;
            first = i / std::size_t(image.channels);
        }
    if (bad > 0)
        throw Error("port " + name + " holds " + std::to_string(bad) + " values that are not finite; the first at pixel (" +
                    std::to_string(first % std::size_t(image.width)) + ", " + std::to_string(first / std::size_t(image.width)) + ")");
}

/// Sample i of a pixel is the same whether it belongs to frame i or to a frame of many samples: a reference with this seed shares its noise.
void warnOfSameSeed(const Path& reference, std::uint32_t seed) {
    if (reference.extension() != ".exr") return;
    const auto attributes = readExrFile(reference).attributes;
    const auto header = attributes.find("lodestir");
    if (header == attributes.end()) return;
    const Json graph = Json::parse(header->second, reference.string());
    const Json* frame = graph.find("frame");
    const Json* used = frame ? frame->find("seed") : nullptr;
    if (used && used->isNumber() && used->asInt() == std::int64_t(seed))
        log::warn("{}: rendered with the same seed ({}), so it shares this image's noise and errors come out too small; give another --seed",
                  reference.string(), seed);
}

/// Is it what a run writes of a frame: SHOWN.12.exr or .png?
bool isFrameOf(const std::string& shown, const Path& file) {
    const std::string name = file.stem().string();
    const bool isImage = file.extension() == ".exr" || file.extension() == ".png";
    return isImage && name.size() > shown.size() + 1 && name.starts_with(shown + ".") &&
           name.find_first_not_of("0123456789", shown.size() + 1) == name.npos;
}

/// Refuses to write over what is read.
void keepInputs(const RunOptions& options, const Description& description, const std::string& shown) {
    for (const Path& input : {options.session.graph, description.scene, options.reference}) {
        if (input.empty()) continue;
        const Path folder = input.has_parent_path() ? input.parent_path() : Path(".");
        if (isSameFile(input, options.out / "run.json") || (!options.trace.empty() && isSameFile(input, options.trace)) ||
            (isFrameOf(shown, input) && isSameFile(folder, options.out)))
            throw Error(Where{input.string()}, "would be written over by what the run writes",
                        "name another folder with --out, or another file");
    }
}

int runGraph(const RunOptions& options) {
    if (options.out.empty()) throw Error("--out names no folder");
    const auto start = std::chrono::steady_clock::now();
    Session session(options.session);
    Graph& graph = session.graph();
    Runner& runner = session.runner();
    std::unique_ptr<ImageData> reference;
    if (!options.reference.empty()) reference = std::make_unique<ImageData>(withoutOpacity(readImage(options.reference)));
    const std::string shown = graph.nameOf(graph.show), resolved = graph.resolved().dump(-1);
    const std::string shownName = graph.description.showPort.empty() ? graph.description.showNode : shown;
    keepInputs(options, graph.description, shownName);
    const bool shownIsImage = graph.port(graph.show).type.kind == PortType::Kind::image;
    if (!shownIsImage && (reference || options.checkNan))
        throw Error(graph.description.showWhere, "the shown port " + shown + " is no image", "--reference and --check-nan need one; see --show");
    MetricOptions how;
    if (reference) how = {.exposure = exposureOf(*reference), .flip = {.exposures = flipExposures(*reference)}};  // once, not for each frame
    if (reference) warnOfSameSeed(options.reference, graph.description.seed);

    nlohmann::ordered_json frames = nlohmann::ordered_json::array();
    std::vector<FrameReport> reports;
    const int count = graph.description.count;
    double setup = 0;
    log::Progress progress("rendering", std::size_t(count));
    const InterruptWatch interrupt;
    bool stop = false;
    for (int i = 0; i < count && !stop; ++i, progress.advance()) {
        const FrameReport report = runner.run();
        stop = interrupt.signal() != 0;
        if (i == 0) setup = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count() - report.milliseconds;
        std::map<std::string, double> metrics;
        const std::string suffix = "." + std::to_string(report.frame);
        const bool write = !options.lastOnly || i + 1 == count || stop;
        if (shownIsImage && (write || reference || options.checkNan)) {
            const ImageData image = runner.readImage(graph.show);
            if (options.checkNan) requireFinite(image, shown);
            if (reference) metrics = evaluateAll(options.metrics, withoutOpacity(image), *reference, how);
            if (write) {
                writeExr(options.out / (shownName + suffix + ".exr"), image, {.attributes = {{"lodestir", resolved}}});
                writePng(options.out / (shownName + suffix + ".png"), preview(image));
            }
        } else if (!shownIsImage && write) {
            dumpPort(graph, runner, graph.show, options.out / (shownName + suffix));
        }
        for (const Source& source : session.dumps()) {
            if (options.checkNan && graph.port(source).type.kind == PortType::Kind::image) requireFinite(runner.readImage(source), graph.nameOf(source));
            if (write) dumpPort(graph, runner, source, options.out / (graph.nameOf(source) + suffix));
        }
        if (!options.trace.empty()) reports.push_back(report);
        frames.push_back(frameJson(report, metrics, options.session.countSteps));
    }
    if (!options.trace.empty()) writeFile(options.trace, traceJson(reports, session.device().facts().name).dump() + "\n");
    nlohmann::ordered_json json = runJson(session, setup);
    const std::size_t done = frames.size();
    const bool interrupted = done < std::size_t(count);
    if (interrupted) json["interrupted"] = interrupt.name();
    json["frames"] = std::move(frames);
    writeFile(options.out / "run.json", json.dump(2) + "\n");
    if (options.json) std::printf("%s\n", json.dump(2).c_str());
    if (interrupted)
        throw Error(fmt::format("interrupted by {} after {} of {} frames, which are whole: {}", interrupt.name(), done, count,
                                options.out.string()));
    if (!session.device().validationMessages().empty())
        throw Error(std::to_string(session.device().validationMessages().size()) +
                    " validation messages; the first: " + session.device().validationMessages()[0]);
    log::note("{} frames of {}x{} on {} ({}): {}", count, runner.size().x, runner.size().y, session.device().facts().name, nameOf(session.rays()),
              options.out.string());
    return 0;
}

}  // namespace

void addRun(CLI::App& app, std::function<int()>& run) {
    auto options = std::make_shared<RunOptions>();
    Command command(app, "run", "Renders a graph's frames and writes images, dumps and run.json.");
    options->session.addTo(command);
    const CommandOption reference =
        command.option("--reference", options->reference, "image to compare the shown port with; the metrics go to run.json").check(checkNotEmpty);
    addMetrics(command, options->metrics, metricNames(), "names of what is measured, separated by commas; see `lodestir compare --help`")
        .needs(reference)
        .showDefault();
    command.option("--out", options->out, "folder for what is written").showDefault();
    command.option("--trace", options->trace, "file for the passes' times as a trace that Perfetto and chrome://tracing show").check(checkNotEmpty);
    command.flag("--check-nan", options->checkNan, "fail when a shown or dumped image holds a value that is not finite");
    command.flag("--last", options->lastOnly, "write images of the last frame only");
    command.flag("--json", options->json, "print run.json as well");
    command.does(run, [options] { return runGraph(*options); });
}

}  // namespace lodestir
