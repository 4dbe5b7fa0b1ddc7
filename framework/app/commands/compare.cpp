// SPDX-License-Identifier: MIT
// lodestir compare TEST REFERENCE: error metrics of two images.
#include <framework/app/commands/commands.h>
#include <framework/app/command_line.h>
#include <framework/app/metric_option.h>
#include <framework/app/validators.h>
#include <framework/core/error.h>
#include <framework/core/files.h>
#include <framework/core/json.h>
#include <framework/core/log.h>
#include <framework/image/color_map.h>
#include <framework/image/image_file.h>
#include <framework/image/metrics.h>
#include <framework/image/sequence.h>
#include <framework/image/temporal.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <memory>
#include <optional>

namespace lodestir {
namespace {

struct CompareArguments {
    std::string test, reference, map, motion;
    std::vector<std::string> metrics;
    bool json = false;
    double exposure = 0, mapTop = 0;    ///< 0: chosen from the images
    std::vector<double> flipExposures;  ///< start, stop, count; empty: chosen from the reference
};

ImageData readColor(const Path& path) {
    const ImageData color = withoutOpacity(readImage(path));
    const auto broken = std::ranges::count_if(color.values, [](float value) { return !std::isfinite(value); });
    if (broken > 0) log::warn("{}: {} values are not finite numbers", path.string(), broken);
    return color;
}

/// The largest errors are often few and far above the rest: the map saturates at the error that one pixel in a hundred exceeds.
double usualTop(const ImageData& map) {
    std::vector<float> errors;
    std::ranges::copy_if(map.values, std::back_inserter(errors), [](float error) { return std::isfinite(error); });
    if (errors.empty()) return 0;
    const auto nth = errors.begin() + static_cast<std::ptrdiff_t>((errors.size() - 1) * 99 / 100);
    std::ranges::nth_element(errors, nth);
    return *nth > 0 ? *nth : std::ranges::max(errors);
}

void writeMap(const CompareArguments& arguments, ImageData map) {
    const Path path = arguments.map;
    if (path.extension() == ".png") {
        for (float& error : map.values) error = std::abs(error);  // bias has a sign, a scale of lightness has none
        const double top = arguments.mapTop > 0 ? arguments.mapTop : usualTop(map);
        writeImage(path, colorMap(map, top));
        log::note("{}: {} per pixel, black is 0, pale yellow is {:.4g} and more", path.string(), arguments.metrics.front(), top);
    } else {
        writeImage(path, map, {{"metric", arguments.metrics.front() + ": " + metricAbout(arguments.metrics.front())}});
    }
}

/// Two metrics have the name FLIP, and numbers of one mean nothing beside those of the other.
void noteFlip(const MetricOptions& options) {
    const double pixels = options.flip.pixelsPerDegree;
    if (options.displayed) {
        log::note("flip: LDR-FLIP of pictures as displayed, {:.4g} pixels per degree", pixels);
    } else {
        const FlipExposures& e = *options.flip.exposures;
        log::note("flip: HDR-FLIP of radiance, {} exposures from {:+.2f} to {:+.2f} stops, {:.4g} pixels per degree", e.count, e.start,
                  e.stop, pixels);
    }
}

/// `displayed`: neither image holds radiance.
MetricOptions optionsFor(const CompareArguments& arguments, const ImageData& reference, bool displayed) {
    MetricOptions options{.exposure = arguments.exposure > 0 ? arguments.exposure : exposureOf(reference),
                          .displayed = displayed && arguments.flipExposures.empty()};
    if (const auto& flip = arguments.flipExposures; !flip.empty()) {
        constexpr int most = 1000;  // more than there are stops between the darkest and the brightest float
        if (!(flip[2] >= 1 && flip[2] <= most && flip[2] == std::floor(flip[2])))
            refuseOption("--flip-exposures", fmt::format("COUNT must be 1 to {}, not {}", most, flip[2]));
        options.flip.exposures = FlipExposures{.start = flip[0], .stop = flip[1], .count = static_cast<int>(flip[2])};
    } else {
        options.flip.exposures = flipExposures(reference);
    }
    if (std::ranges::any_of(arguments.metrics, [](const std::string& name) { return name == "flip" || name == "tflip"; }))
        noteFlip(options);
    return options;
}

/// Metrics of images, or those of sequences, among `names`.
std::vector<std::string> chosen(const std::vector<std::string>& names, bool temporal) {
    std::vector<std::string> some;
    std::ranges::copy_if(names, std::back_inserter(some), [&](const std::string& name) { return isTemporal(name) == temporal; });
    return some;
}

std::map<std::string, double> compareImages(const CompareArguments& arguments) {
    if (const auto temporal = chosen(arguments.metrics, true); !temporal.empty())
        throw Error("\"" + temporal.front() + "\" needs two frames in a row", "name a sequence: out/display.%d.exr");
    const ImageData test = readColor(arguments.test), reference = readColor(arguments.reference);
    const MetricOptions options = optionsFor(arguments, reference, isDisplayed(arguments.test) && isDisplayed(arguments.reference));
    if (!arguments.map.empty()) writeMap(arguments, errorMap(arguments.metrics.front(), test, reference, options));
    return evaluateAll(arguments.metrics, test, reference, options);
}

/// The files of a sequence for the frames of another: its own, or one image that stands for all of them.
std::map<int, Path> filesFor(const std::map<int, Path>& frames, const Path& path) {
    std::map<int, Path> files;
    if (!isSequence(path)) {
        for (const auto& [number, file] : frames) files[number] = path;
        return files;
    }
    files = sequenceFiles(path);
    for (const auto& [number, file] : frames)
        if (!files.contains(number))
            throw Error(Where{path.string()}, "there is no file of frame " + std::to_string(number), "TEST has " + file.string());
    if (files.size() > frames.size())
        log::warn("{}: {} frames have no test image and are left out", path.string(), files.size() - frames.size());
    return files;
}

/// Means over the frames, and over the steps from one frame to the next.
std::map<std::string, double> compareSequences(const CompareArguments& arguments) {
    if (!arguments.map.empty()) throw Error("--map shows the error of one image", "name a frame instead of a sequence");
    const std::map<int, Path> tests = sequenceFiles(arguments.test), references = filesFor(tests, arguments.reference);
    const std::map<int, Path> motions = arguments.motion.empty() ? std::map<int, Path>() : filesFor(tests, arguments.motion);
    const std::vector<std::string> still = chosen(arguments.metrics, false), temporal = chosen(arguments.metrics, true);
    std::map<std::string, double> sums;
    std::optional<MetricOptions> options;
    ImageData testBefore, referenceBefore;
    int before = 0, steps = 0;
    for (const auto& [number, file] : tests) {
        ImageData test = readColor(file), reference = readColor(references.at(number));
        if (!options) options = optionsFor(arguments, reference, isDisplayed(file) && isDisplayed(references.at(number)));
        for (const auto& [name, value] : evaluateAll(still, test, reference, *options)) sums[name] += value / double(tests.size());
        if (!testBefore.values.empty() && before + 1 == number) {
            ++steps;
            const ImageData motion = motions.empty() ? ImageData() : readImage(motions.at(number));
            const Step step{test, testBefore, reference, referenceBefore, motions.empty() ? nullptr : &motion};
            for (const std::string& name : temporal) sums[name] += evaluateStep(name, step, *options);
        }
        testBefore = std::move(test), referenceBefore = std::move(reference), before = number;
    }
    if (steps == 0 && !temporal.empty())
        throw Error(Where{arguments.test}, "no two frames follow each other, which \"" + temporal.front() + "\" needs");
    for (const std::string& name : temporal) sums[name] /= steps;
    log::note("means over {} frames and {} steps from one to the next", tests.size(), steps);
    return sums;
}

int compare(CompareArguments arguments) {
    const bool sequence = isSequence(arguments.test);
    for (const std::string& input : {arguments.test, arguments.reference})
        if (!arguments.map.empty() && isSameFile(arguments.map, input))
            throw Error(Where{arguments.map}, "--map would write over an image that is compared", "name another file");
    if (!sequence && (isSequence(arguments.reference) || !arguments.motion.empty()))
        throw Error(Where{arguments.test}, "is one image, to be compared with one image", "a sequence is named by %d: out/display.%d.exr");
    if (arguments.metrics.empty()) {
        arguments.metrics = metricNames();
        if (sequence) std::ranges::copy(temporalMetricNames(), std::back_inserter(arguments.metrics));
    }
    const std::map<std::string, double> found = sequence ? compareSequences(arguments) : compareImages(arguments);
    Json values = Json::object();
    for (const std::string& name : arguments.metrics) values[name] = Json(found.at(name));
    if (arguments.json) {
        fmt::print("{}\n", values.dump(-1));
    } else {
        for (const auto& [name, value] : values.members()) fmt::print("{:<{}}{:.6g}\n", name, sequence ? 24 : 16, value.asNumber());
    }
    return 0;
}

std::string metricHelp() {
    std::string text = "metrics (x: TEST, r: REFERENCE):\n";
    for (const std::string& name : metricNames()) text += fmt::format("  {:<16}{}\n", name, metricAbout(name));
    text += "metrics of sequences (t: number of the frame):\n";
    for (const std::string& name : temporalMetricNames()) text += fmt::format("  {:<24}{}\n", name, temporalMetricAbout(name));
    return text;
}

}  // namespace

void addCompare(CLI::App& app, std::function<int()>& run) {
    const auto arguments = std::make_shared<CompareArguments>();
    Command command(app, "compare", "error metrics of two images or sequences of images");
    command
        .option("TEST", arguments->test, "image to judge (.exr, .png, .jpg, .hdr; opacity is left out), or a sequence: out/display.%d.exr")
        .required();
    command.option("REFERENCE", arguments->reference, "image to judge it by, or a sequence").required();
    std::vector<std::string> known = metricNames();
    std::ranges::copy(temporalMetricNames(), std::back_inserter(known));
    addMetrics(command, arguments->metrics, std::move(known), "names, separated by commas (all)");
    command.flag("--json", arguments->json, "print one JSON object");
    command
        .option("--exposure", arguments->exposure,
                "factor on both images for metrics with an epsilon or a tone curve (median luminance becomes 0.18)")
        .check(checkPositive);
    command
        .option("--flip-exposures", arguments->flipExposures,
                "START,STOP,COUNT in stops for flip, to be the same for all frames that are compared (chosen from REFERENCE)")
        .list(3);
    command.option("--motion", arguments->motion,
                   "sequence of motions, from each pixel to where it was a frame ago, for the flicker of what moves: out/hits.motion.%d.exr");
    command.option("--map", arguments->map, "write the error of each pixel by the first metric: .exr (values) or .png (colours)")
        .check([](const std::string& name) {
            const std::string extension = Path(name).extension().string();
            return extension == ".exr" || extension == ".png" ? std::string() : "\"" + name + "\" must end in .exr or .png";
        });
    command.option("--map-top", arguments->mapTop, "error shown brightest in a .png map (99 % of the pixels are below)")
        .check(checkPositive);
    command.footer(metricHelp());
    command.does(run, [arguments] { return compare(*arguments); });
}

}  // namespace lodestir
