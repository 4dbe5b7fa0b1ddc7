// SPDX-License-Identifier: MIT
// What happened to one pixel, told by the shaders: its paths drawn into the scene, and all that was told as a tree to unfold.
#pragma once
#include <framework/app/view/render_thread.h>
#include <framework/app/view/viewport.h>

#include <functional>

namespace lodestir {

class PixelPanel {
public:
    using Mark = std::function<void(const std::string& name)>;  ///< names the widget drawn last
    PixelPanel(RenderThread& renderer, Mark mark) : renderer_(renderer), mark_(std::move(mark)) {}

    /// Asks the pixel that the pointer is on; closes where that is none.
    void ask(const Viewport& viewport);
    void close();
    /// Over `area`, where there is something to tell. `camera`: that the picture is seen with.
    void draw(const ViewStatus& status, const Viewport& viewport, const CameraKey& camera, const Rectangle& area);

private:
    void drawPaths(const PixelTold& told, const Viewport& viewport, const CameraKey& camera, const Rectangle& area) const;
    void drawList(const PixelTold& told);

    RenderThread& renderer_;
    Mark mark_;
    int path_ = -1;  ///< that the pointer is on in the list; -1: all are seen
};

}  // namespace lodestir
