// SPDX-License-Identifier: MIT
// `lodestir probe`: what happened to one pixel in one frame, told by the shaders themselves.
#include <framework/app/command_line.h>
#include <framework/app/commands/commands.h>
#include <framework/app/pixel_report.h>
#include <framework/app/session.h>
#include <framework/core/json.h>
#include <framework/core/log.h>

#include <fmt/format.h>
#include <lodestir/revision.h>
#include <nlohmann/json.hpp>

#include <charconv>
#include <cstdio>
#include <limits>
#include <memory>

namespace lodestir {
namespace {

using OrderedJson = nlohmann::ordered_json;

struct ProbeOptions {
    SessionOptions session;
    glm::ivec2 pixel{0};
    int frame = 0;
};

glm::ivec2 readPixel(const std::string& text) {
    glm::ivec2 pixel{0};
    const char* end = text.data() + text.size();
    const auto [x, ok] = std::from_chars(text.data(), end, pixel.x);
    if (ok == std::errc() && x != end && *x == ',') {
        const auto [rest, good] = std::from_chars(x + 1, end, pixel.y);
        if (good == std::errc() && rest == end) return pixel;
    }
    refuseOption("--pixel", "\"" + text + "\" is no pixel; write it like 109,69");
}

int probePixel(const ProbeOptions& options) {
    SessionParts parts;
    parts.probe = true;
    parts.adjust = [&](Graph& graph) {
        const glm::ivec2 pixel = options.pixel, size = graph.description.size;
        if (pixel.x < 0 || pixel.y < 0 || pixel.x >= size.x || pixel.y >= size.y)
            refuseOption("--pixel", fmt::format("({}, {}) lies outside the frame of {}x{} pixels; the last one is {},{}", pixel.x, pixel.y, size.x, size.y,
                                                size.x - 1, size.y - 1));
    };
    Session session(options.session, std::move(parts));
    const Graph& graph = session.graph();
    Runner& runner = session.runner();
    log::Progress progress("rendering", std::size_t(options.frame) + 1);
    for (int frame = 0; frame < options.frame; ++frame, progress.advance()) runner.run();
    const std::vector<ProbedDispatch> told = runner.probe(options.pixel);
    progress.advance();

    const OrderedJson json{{"lodestir", std::string(LODESTIR_VERSION)},
                           {"graph", graph.description.file.string()},
                           {"scene", graph.description.scene.string()},
                           {"size", {runner.size().x, runner.size().y}},
                           {"seed", graph.description.seed},
                           {"frame", options.frame},
                           {"pixel", {options.pixel.x, options.pixel.y}},
                           {"passes", pixelReport(session, told, options.pixel)}};
    std::printf("%s\n", Json::from(json).dump().c_str());
    return 0;
}

}  // namespace

void addProbe(CLI::App& app, std::function<int()>& run) {
    const auto options = std::make_shared<ProbeOptions>();
    Command command(app, "probe", "Prints what happened to one pixel in one frame, as JSON: paths, shifts, weights, ports.");
    options->session.addGraph(command);
    command.taken<std::string>("--pixel", [options](const std::string& v) { options->pixel = readPixel(v); }, "X,Y from the upper left").required();
    command.option("--frame", options->frame, "number of the frame; those before it are rendered first")
        .within(0, std::numeric_limits<int>::max())
        .showDefault();
    command.does(run, [options] { return probePixel(*options); });
}

}  // namespace lodestir
