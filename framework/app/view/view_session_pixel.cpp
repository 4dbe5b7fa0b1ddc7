// SPDX-License-Identifier: MIT
// The part of a viewer's session that asks a pixel what happened to it.
#include <framework/app/view/view_session.h>

#include <framework/app/pixel_report.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace lodestir {
namespace {

constexpr std::uint32_t framesBeforeAsked = 8;  // of history behind a pixel that is asked: most of what 20 would hold, in less than half of the time

}  // namespace

void ViewSession::askPixel(glm::ivec2 pixel) {
    const glm::ivec2 shown(status_.picture.extent);
    if (!session_ || broken_ || shown.x == 0) return;
    attempt([&] {
        const auto setAlike = [&](Graph& graph) {
            for (const GraphNode& node : session_->graph().nodes)
                for (const Parameter* parameter : node.pass->parameters)
                    for (Parameter* same : graph.nodes[std::size_t(graph.find(node.name))].pass->parameters)
                        if (same->name == parameter->name) same->value = parameter->value;
        };
        status_.busy = "asking the pixel";
        tell();
        if (!asking_) {
            asking_ = std::make_unique<Session>(options_, SessionParts{.device = device_,
                                                                       .scene = session_->sharedScene(),
                                                                       .adjust = setAlike,
                                                                       .slice = slice,
                                                                       .probe = true,
                                                                       .compiled = compiling()});
        }
        setAlike(asking_->graph());
        Runner& runner = asking_->runner();
        const std::uint32_t frame = status_.nextFrame - 1, first = frame - std::min(frame, framesBeforeAsked);
        runner.reset();
        runner.setFrame(first);
        for (std::uint32_t f = first; f < frame; ++f) {
            status_.busy = fmt::format("asking the pixel: frame {} of {}", f - first + 1, frame - first + 1);
            tell();
            runner.run();
        }
        pixel = pixel * glm::ivec2(runner.size()) / shown;  // of the frame, of which what is shown may be a half
        const std::vector<ProbedDispatch> told = runner.probe(pixel);
        auto passes = std::make_shared<const nlohmann::ordered_json>(pixelReport(*asking_, told, pixel));
        std::vector<ToldPath> paths = pathsIn(*passes);
        status_.told = std::make_shared<const PixelTold>(PixelTold{pixel, runner.size(), frame, first, std::move(passes), std::move(paths)});
    });
    status_.busy.clear();
    tell();
}

void ViewSession::forgetPixel() {
    status_.told.reset();
    tell();
}

}  // namespace lodestir
