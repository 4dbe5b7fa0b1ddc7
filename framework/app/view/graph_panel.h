// SPDX-License-Identifier: MIT
// The running graph over the picture: passes as boxes, their ports, and the edges between them; mouse and menus edit it live.
#pragma once
#include <framework/app/view/graph_layout.h>
#include <framework/app/view/picture_painter.h>
#include <framework/app/view/render_thread.h>

#include <imgui/imgui.h>

#include <array>
#include <functional>
#include <map>
#include <optional>
#include <string>

namespace lodestir {

class GraphPanel {
public:
    using Mark = std::function<void(const std::string& name)>;  ///< names the widget drawn last
    using Show = std::function<void(const std::string& port)>;
    GraphPanel(RenderThread& renderer, Mark mark, Show show) : renderer_(renderer), mark_(std::move(mark)), show_(std::move(show)) {}

    bool isOpen() const { return open_; }
    void toggle();
    void fit() { zoom_ = 0; }  ///< all of the graph is seen
    /// Over `area`, where it is open. `shown`: the port that the picture is of.
    void draw(const ViewStatus& status, const std::string& shown, const Rectangle& area);

private:
    /// A port that is seen: an input or an output of a pass, by their numbers.
    struct Spot {
        bool isInput = false;
        int pass = -1, wire = -1;
        bool operator==(const Spot&) const = default;
    };

    void follow(const ViewStatus& status);
    void measure();
    void place(const Rectangle& canvas);
    void interact(const Rectangle& canvas);
    void interactWith(const Spot& spot);
    void drop();
    void tellOf(const Spot& spot) const;

    void drawEdges(ImDrawList& list) const;
    void drawEdge(ImDrawList& list, std::size_t edge, bool bright) const;
    void drawBox(ImDrawList& list, const ViewStatus& status, int pass) const;
    void drawPort(ImDrawList& list, const Spot& spot) const;
    void drawDrag(ImDrawList& list) const;

    void drawBar(const ViewStatus& status);
    void drawPassMenu();
    void drawAddMenu();

    const WireInfo& wire(const Spot& spot) const;
    /// The edge that ends in an input; null: it is unwired.
    const EdgeInfo* edgeInto(const Spot& input) const;
    /// How the input names the output; null: it doesn't fit.
    const Offer* offer(const Spot& output, const Spot& input) const;
    bool takesDrag(const Spot& spot) const;  ///< would what is dragged fit here?
    std::optional<Spot> spotAt(ImVec2 place) const;
    int passAt(ImVec2 place) const;
    ImVec2 screen(glm::vec2 place) const { return {origin_.x + zoomed_ * place.x, origin_.y + zoomed_ * place.y}; }
    Rectangle rowOf(const Spot& spot) const;  ///< on the screen
    ImVec2 dotOf(const Spot& spot) const;
    void send(RenderThread::Task task) { renderer_.post(std::move(task)); }

    RenderThread& renderer_;
    Mark mark_;
    Show show_;
    bool open_ = false, asked_ = false;
    std::shared_ptr<const GraphInfo> graph_;
    std::string shown_;  ///< the port that the picture is of
    std::vector<LayoutBox> boxes_;
    GraphLayout layout_;
    float zoom_ = 0, zoomed_ = 1;      ///< wanted, 0: as fits; pixels of the window for one of the layout
    glm::vec2 centre_{0}, origin_{0};  ///< of the layout in the canvas' middle; of the layout on the screen
    int panning_ = -1;                 ///< button that moves it
    std::optional<Spot> hovered_, drag_;
    int hoveredPass_ = -1;
    std::string menuPass_;               ///< whose menu is open
    std::array<char, 64> filter_{};      ///< of the types that can be added
    std::optional<std::size_t> adding_;  ///< the type whose questions are asked
    std::map<std::string, std::string> answers_;
};

}  // namespace lodestir
