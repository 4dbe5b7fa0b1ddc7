// SPDX-License-Identifier: MIT
// The panel beside a comparison: what A and B are and cost, how their errors fall from frame to frame, how their numbers are distributed.
#pragma once
#include <framework/app/view/picture_painter.h>
#include <framework/app/view/render_thread.h>

#include <functional>
#include <string>

namespace lodestir {

class ComparisonPanel {
public:
    using Mark = std::function<void(const std::string& name)>;  ///< names the widget drawn last
    /// `out`: folder for studies.
    ComparisonPanel(RenderThread& renderer, Mark mark, Path out) : renderer_(renderer), mark_(std::move(mark)), out_(std::move(out)) {}

    /// It opens by itself when there is something to compare.
    void toggle() { open_ = !open_; }
    /// In the corner of `area`, where it is open.
    void draw(const ViewStatus& status, const Rectangle& area);

private:
    void drawSides(const ViewStatus& status);
    void drawErrors(const ComparedNumbers& numbers);
    void drawStudy();
    void send(RenderThread::Task task) { renderer_.post(std::move(task)); }

    RenderThread& renderer_;
    Mark mark_;
    Path out_;
    bool open_ = false, compares_ = false;
    bool plotsMse_ = false;
};

}  // namespace lodestir
