// SPDX-License-Identifier: MIT
// The panels of the viewer: what runs, what is shown, camera, parameters of all passes, times and rays. Made from the declarations.
#pragma once
#include <framework/app/view/comparison.h>
#include <framework/app/view/comparison_panel.h>
#include <framework/app/view/graph_panel.h>
#include <framework/app/view/pixel_panel.h>
#include <framework/app/view/render_thread.h>
#include <framework/app/view/scene_panel.h>
#include <framework/app/view/viewport.h>
#include <framework/app/view/window.h>

#include <map>

namespace lodestir {

class Panels {
public:
    /// `out`: folder for what is saved. `frameTime`: milliseconds that the size of frames is to follow, 0: none. `wantsStatistics`: numbers of every
    /// picture, for whoever watches the viewer.
    Panels(RenderThread& renderer, Window& window, Viewport& viewport, Comparison& comparison, Path out, float frameTime, bool wantsStatistics);

    /// Draws all panels of one UI frame and sends what the user wants to the renderer.
    void draw(const ViewStatus& status);
    /// Where the picture goes: what the panels leave of a window of this size.
    Rectangle pictureArea(glm::uvec2 window) const;
    /// Over the picture: what is compared with what, the pixel under the pointer.
    void drawProbe(const ViewStatus& status, const std::optional<PicturePainter::Probe>& probe, const Rectangle& area);

    const Comparison& comparison() const { return comparison_; }
    const Look& look() const { return look_; }  ///< for the picture of this frame
    TexelLayout layout() const;
    bool takeScreenshotWish() { return std::exchange(screenshot_, false); }
    /// What is in view of all widgets drawn last, "pass.parameter" or a name such as "pause": left, top, right, bottom; top = bottom where one is
    /// scrolled away.
    const std::map<std::string, std::array<float, 4>>& widgets() const { return widgets_; }
    const std::map<std::string, Value>& values() const { return values_; }  ///< of all parameters, as set here

private:
    struct Shown {
        std::size_t field = 0;
        Look look;
        bool automatic = false;  ///< range follows the picture
    };

    /// How a picture looks best at first, going by its numbers and its name.
    static Look firstLook(const std::string& port, const PortField& field, bool& automatic);
    void follow(const ViewStatus& status);
    void keys(const ViewStatus& status);
    void drawGraph(const ViewStatus& status);
    void drawShown();
    void drawLook(Shown& shown, const PortField& field);
    void drawComparison(const ViewStatus& status);
    void drawCamera(const ViewStatus& status);
    void drawPasses();
    void drawParameter(const PassInfo& pass, std::size_t index);
    void drawOutput(const ViewStatus& status);
    void drawSize();
    void followTime(const Rectangle& area);
    void drawTimes(const ViewStatus& status);
    void drawFacts(const ViewStatus& status);
    void drawProblems(const ViewStatus& status);
    void drawHelp();

    bool button(const char* name, const char* label, const char* tip, float width = 0);
    void mark(const std::string& name);
    void showPort(const std::string& port);
    void sendShow();
    void keepA(const ViewStatus& status);
    void runA(const ViewStatus& status);
    void moveCamera(const std::optional<CameraKey>& camera);
    void drawScene(const ViewStatus& status);
    ScenePanel::Host sceneHost();
    void send(RenderThread::Task task) { renderer_.post(std::move(task)); }

    RenderThread& renderer_;
    Window& window_;
    Viewport& viewport_;
    Comparison& comparison_;
    GraphPanel graphPanel_;
    PixelPanel pixelPanel_;
    ComparisonPanel comparisonPanel_;
    ScenePanel scenePanel_;
    Path out_;
    float frameTime_;                                   ///< milliseconds that the size of frames follows; 0: it stays
    std::pair<float, glm::ivec2> followed_{0, {0, 0}};  ///< what the renderer was told of it, and of the place there is
    bool wantsStatistics_;
    std::shared_ptr<const GraphInfo> graph_;
    std::map<std::string, Value> values_;
    std::map<std::string, Shown> shownOf_;  ///< by port
    std::string port_;
    Look look_;
    bool paused_ = false, help_ = false, screenshot_ = false;
    std::map<std::string, std::array<float, 4>> widgets_;
};

}  // namespace lodestir
