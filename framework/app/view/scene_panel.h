// SPDX-License-Identifier: MIT
// The scene at the right of the picture: instances and their levels, looks and lights, cameras and time. What is chosen there edits the graph that runs.
#pragma once
#include <framework/app/view/camera_path.h>
#include <framework/app/view/picture_painter.h>
#include <framework/app/view/render_thread.h>

#include <imgui/imgui.h>

#include <array>
#include <functional>
#include <map>
#include <optional>
#include <string>

namespace lodestir {

inline constexpr float scenePanelWidth = 404;  ///< pixels

class ScenePanel {
public:
    /// What the panel asks of the others.
    struct Host {
        std::function<void(const std::string& name)> mark;  ///< names the widget drawn last
        std::function<const Value&(const std::string& name)> value;
        std::function<void(const std::string& name, const Value& value)> set;
        std::function<void(const std::string& port)> show;
        std::function<void(const std::optional<CameraKey>& camera)> moveCamera;  ///< nothing: the scene's own again
        std::function<void()> letGo;                                             ///< the camera is the renderer's to say
    };
    /// `out`: folder of saved views and paths.
    ScenePanel(RenderThread& renderer, Host host, Path out) : renderer_(renderer), host_(std::move(host)), out_(std::move(out)) {}

    bool isOpen() const { return open_; }
    void toggle();
    /// At the right edge of the window; `camera`: that the viewer has just now.
    void draw(const ViewStatus& status, const CameraKey& camera, const Rectangle& area);
    /// Around what is picked. `toImage`: from pixels of the rectangle to those of the image.
    void drawOver(const ViewStatus& status, const Rectangle& picture, const glm::mat3& toImage) const;
    /// The pixel of the image that was clicked on.
    void click(glm::vec2 place) {
        send([place](ViewSession& s) { s.pick(place); });
    }

private:
    void follow(const ViewStatus& status);
    void drawLevels(const ViewStatus& status);
    void drawInstances(const ViewStatus& status);
    void drawInstance(const ViewStatus& status, std::uint32_t instance);
    void drawLevel(std::uint32_t instance, std::uint32_t level, std::uint32_t forced);
    void drawPicked(const ViewStatus& status);
    void drawMaterials(const ViewStatus& status);
    void drawLights(const ViewStatus& status);
    void drawCamera(const ViewStatus& status, const CameraKey& camera);
    void drawTime(const ViewStatus& status);
    void drawViews(const CameraKey& camera);
    void drawPath(const CameraKey& camera);

    bool button(const std::string& name, const char* label, const std::string& about, float width = 0);
    /// A factor or share that a pass is to have: the slider, and the dot that takes it back. `edit`: the pass, empty where there is none yet.
    struct Knob {
        const char* label;
        std::string about, edit;
        ViewSession::SceneEdit what;  ///< its value: what holds where nobody edits
        float low, high, shown;       ///< shown: what the slider has where nobody edits
        float each = 1;               ///< of the unit that is shown, for a value of 1
        const char* format = "%.3g";  ///< of what is shown
    };
    void drawKnob(const Knob& knob);
    void drawPower(float given, const char* format, const std::string& edit, const ViewSession::SceneEdit& what);
    /// As it is, or will be when the renderer has put the pass in.
    const Value& valueNow(const std::string& edit, const ViewSession::SceneEdit& what) const;
    void sendEdit(const std::string& edit, const ViewSession::SceneEdit& what);
    void keepViews();
    Path viewsFile() const;
    void send(RenderThread::Task task) { renderer_.post(std::move(task)); }

    RenderThread& renderer_;
    Host host_;
    Path out_;
    bool open_ = false, wantsColors_ = false;
    std::shared_ptr<const GraphInfo> graph_;
    std::string scene_;  ///< whose views these are
    std::array<char, 64> filter_{};
    std::vector<std::uint32_t> listed_;  ///< instances that pass the filter
    std::vector<SavedView> views_;
    std::string viewsProblem_;
    std::array<char, 64> viewName_{};
    std::vector<CameraKey> path_;
    std::map<std::string, Value> pending_;  ///< sent to passes that aren't there yet
};

}  // namespace lodestir
