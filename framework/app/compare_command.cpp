// SPDX-License-Identifier: MIT
// lodestir compare TEST REFERENCE: error metrics of two images.
#include <framework/app/compare_command.h>
#include <framework/core/error.h>
#include <framework/core/files.h>
#include <framework/core/json.h>
#include <framework/core/log.h>
#include <framework/image/color_map.h>
#include <framework/image/image_file.h>
#include <framework/image/metrics.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

namespace lodestir {
namespace {

struct CompareArguments {
    std::string test, reference, map;
    std::vector<std::string> metrics;
    bool json = false;
    double exposure = 0, mapTop = 0;    ///< 0: chosen from the images
    std::vector<double> flipExposures;  ///< start, stop, count; empty: chosen from the reference
};

/// Opacity is no light: the same picture must have the same error whether it was saved with opacity or without.
ImageData readColor(const Path& path) {
    const ImageData image = readImage(path);
    const ImageData color = image.channels == 4 || image.channels == 2 ? firstChannels(image, image.channels - 1) : image;
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

int compare(CompareArguments arguments) {
    if (arguments.metrics.empty()) arguments.metrics = metricNames();
    const ImageData test = readColor(arguments.test), reference = readColor(arguments.reference);
    MetricOptions options;
    if (arguments.exposure > 0) options.exposure = arguments.exposure;
    if (const auto& flip = arguments.flipExposures; !flip.empty())
        options.flip.exposures = FlipExposures{.start = flip[0], .stop = flip[1], .count = static_cast<int>(flip[2])};

    Json values = Json::object();
    for (const std::string& name : arguments.metrics) values[name] = Json(evaluate(name, test, reference, options));
    if (!arguments.map.empty()) writeMap(arguments, errorMap(arguments.metrics.front(), test, reference, options));
    if (arguments.json) {
        fmt::print("{}\n", values.dump(-1));
    } else {
        for (const auto& [name, value] : values.members()) fmt::print("{:<16}{:.6g}\n", name, value.asNumber());
    }
    return 0;
}

std::string metricHelp() {
    std::string text = "metrics (x: TEST, r: REFERENCE):\n";
    for (const std::string& name : metricNames()) text += fmt::format("  {:<16}{}\n", name, metricAbout(name));
    return text;
}

}  // namespace

void addCompare(CLI::App& app, std::function<int()>& run) {
    const auto arguments = std::make_shared<CompareArguments>();
    CLI::App* command = app.add_subcommand("compare", "error metrics of two images");
    command->add_option("TEST", arguments->test, "image to judge (.exr, .png, .hdr); opacity is left out")->required();
    command->add_option("REFERENCE", arguments->reference, "image to judge it by")->required();
    command->add_option("--metrics", arguments->metrics, "names, separated by commas (all)")
        ->delimiter(',')
        ->allow_extra_args(false)  // what follows may be TEST
        ->check([](const std::string& name) {
            const std::vector<std::string> names = metricNames();
            const bool isKnown = std::ranges::find(names, name) != names.end();
            return isKnown ? std::string() : "unknown metric \"" + name + "\"; " + didYouMean(name, names);
        });
    command->add_flag("--json", arguments->json, "print one JSON object");
    command
        ->add_option("--exposure", arguments->exposure,
                     "factor on both images for metrics with an epsilon or a tone curve (median luminance becomes 0.18)")
        ->check(CLI::PositiveNumber);
    command
        ->add_option("--flip-exposures", arguments->flipExposures,
                     "START,STOP,COUNT in stops for flip, to be the same for all frames that are compared (chosen from REFERENCE)")
        ->delimiter(',')
        ->expected(3)
        ->allow_extra_args(false);
    command->add_option("--map", arguments->map, "write the error of each pixel by the first metric: .exr (values) or .png (colours)");
    command->add_option("--map-top", arguments->mapTop, "error shown brightest in a .png map (99 % of the pixels are below)")
        ->check(CLI::PositiveNumber);
    command->footer(metricHelp());
    command->callback([arguments, &run] { run = [arguments] { return compare(*arguments); }; });
}

}  // namespace lodestir
