// SPDX-License-Identifier: MIT
#include <framework/app/view/live_side.h>

#include <framework/app/dump.h>
#include <framework/app/view/port_info.h>
#include <framework/app/view/smooth.h>

#include <fmt/format.h>

namespace lodestir {

void LiveSide::follow(Session& other) {
    // One scene for both, and not two that are alike: whoever moves its camera moves that of both.
    if (runner_ && scene_ == other.sharedScene()) {
        const glm::uvec2 size = other.runner().size();
        if (runner_->size() == size) return;
        runner_->resize(size);
        graph_->description.size = size;
        port_ = describePort(*graph_, *runner_, port_.source);
        return;
    }
    runner_.reset();
    scene_ = other.sharedScene();
    const GraphOptions changes{.scene = scene_->file, .frames = {}, .size = other.runner().size(), .seed = {}, .set = {}, .variant = {}, .show = {}};
    graph_ = std::make_unique<Graph>(buildGraph(readDescription(side_.whole, side_.file, changes), renderer_.libraries()));
    const Source shown = side_.port.empty() ? graph_->show : findSource(*graph_, side_.port);
    runner_ = renderer_.bringUp(*graph_, *scene_, {.pinned = {shown}, .slice = slice}, compiled_);
    port_ = describePort(*graph_, *runner_, shown);
    if (side_.port.empty() && !port_.fields.empty()) side_.layout = port_.fields.front().layout;
    side_.port = port_.name;
}

void LiveSide::frame(Session& other, std::uint32_t number, Captures& captures) {
    follow(other);
    runner_->setFrame(number);
    const FrameReport report = runner_->run();
    smooth(milliseconds_, report.milliseconds);
    picture_ = captures.take(*runner_, port_, scene_->cameraAt(float(number)));
}

void LiveSide::reset() {
    if (runner_) runner_->reset();
}

void LiveSide::save(const Path& folder) { dumpPort(*graph_, *runner_, port_.source, folder / fmt::format("A.{}.{}", port_.name, picture_.frame)); }

}  // namespace lodestir
