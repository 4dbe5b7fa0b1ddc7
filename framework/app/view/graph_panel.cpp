// SPDX-License-Identifier: MIT
// Where the graph panel puts things, and what the mouse does to them.
#include <framework/app/view/graph_panel.h>

#include <framework/app/view/graph_panel_style.h>
#include <framework/app/view/panel_style.h>
#include <framework/app/view/theme.h>

#include <algorithm>
#include <cmath>

namespace lodestir {

void GraphPanel::toggle() {
    open_ = !open_;
    drag_.reset();
    if (!std::exchange(asked_, true)) send([](ViewSession& s) { s.offerEdits(); });
}

void GraphPanel::follow(const ViewStatus& status) {
    if (status.graph == graph_) return;
    graph_ = status.graph;
    drag_.reset();
    measure();
}

void GraphPanel::measure() {
    boxes_.clear();
    for (const PassInfo& pass : graph_->passes) {
        float width = std::max({leastWidth, textWidth(pass.name, nameSize) + 2 * boxPadding, textWidth(pass.type, smallSize) + 2 * boxPadding});
        for (const auto* wires : {&pass.inputs, &pass.outputs})
            for (const WireInfo& wire : *wires) width = std::max(width, textWidth(wire.name, portSize) + 2 * boxPadding);
        LayoutBox box{.size = {width, 0}};
        float y = headHeight;
        for (std::size_t i = 0; i < pass.inputs.size(); ++i, y += rowHeight) box.inputs.push_back(y + 0.5f * rowHeight);
        for (std::size_t i = 0; i < pass.outputs.size(); ++i, y += rowHeight) box.outputs.push_back(y + 0.5f * rowHeight);
        box.size.y = y + footHeight;
        boxes_.push_back(std::move(box));
    }
    std::vector<LayoutEdge> edges;
    for (const EdgeInfo& edge : graph_->edges) edges.push_back({edge.from, edge.output, edge.to, edge.input, edge.prev});
    layout_ = layOut(boxes_, edges);
}

/// Zoom and place of the layout in the canvas.
void GraphPanel::place(const Rectangle& canvas) {
    const glm::vec2 size(canvas.size), corner(canvas.corner);
    if (zoom_ <= 0) {
        const glm::vec2 room = glm::max(size - 2.0f * canvasMargin, glm::vec2(1)) / glm::max(layout_.size, glm::vec2(1));
        zoomed_ = std::min({room.x, room.y, 1.0f});
        centre_ = 0.5f * layout_.size;
    } else {
        zoomed_ = zoom_;
    }
    origin_ = glm::round(corner + 0.5f * size - zoomed_ * centre_);
}

void GraphPanel::draw(const ViewStatus& status, const std::string& shown, const Rectangle& area) {
    if (!open_ || !status.graph || area.size.x <= 0 || area.size.y <= 0) return;
    follow(status);
    shown_ = shown;
    ImGui::SetNextWindowPos({float(area.corner.x), float(area.corner.y)});
    ImGui::SetNextWindowSize({float(area.size.x), float(area.size.y)});
    ImGui::PushStyleColor(ImGuiCol_WindowBg, panelBack);
    ImGui::Begin("graph", nullptr, fixedWindow | ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse);
    drawBar(status);
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const Rectangle canvas{{area.corner.x, int(corner.y)}, {area.size.x, std::max(area.corner.y + area.size.y - int(corner.y), 1)}};
    place(canvas);
    const ImVec2 low{float(canvas.corner.x), float(canvas.corner.y)}, high{low.x + float(canvas.size.x), low.y + float(canvas.size.y)};
    ImGui::PushClipRect(low, high, true);
    interact(canvas);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    drawEdges(list);
    for (int pass = 0; pass < int(boxes_.size()); ++pass) drawBox(list, status, pass);
    drawDrag(list);
    ImGui::PopClipRect();
    drawPassMenu();
    ImGui::End();
    ImGui::PopStyleColor();
}

Rectangle GraphPanel::rowOf(const Spot& spot) const {
    const GraphLayout::Box& box = layout_.boxes[std::size_t(spot.pass)];
    const LayoutBox& ports = boxes_[std::size_t(spot.pass)];
    const float middle = (spot.isInput ? ports.inputs : ports.outputs)[std::size_t(spot.wire)];
    const ImVec2 corner = screen(box.corner + glm::vec2(0, middle - 0.5f * rowHeight));
    const float reach = zoomed_ * dotRadius * 2;  // the dot stands out of the box
    return {{int(corner.x - (spot.isInput ? reach : 0)), int(corner.y)}, {int(zoomed_ * box.size.x + reach), std::max(int(zoomed_ * rowHeight), 1)}};
}

ImVec2 GraphPanel::dotOf(const Spot& spot) const {
    const GraphLayout::Box& box = layout_.boxes[std::size_t(spot.pass)];
    const LayoutBox& ports = boxes_[std::size_t(spot.pass)];
    if (spot.isInput) return screen(box.corner + glm::vec2(0, ports.inputs[std::size_t(spot.wire)]));
    return screen(box.corner + glm::vec2(box.size.x, ports.outputs[std::size_t(spot.wire)]));
}

std::optional<GraphPanel::Spot> GraphPanel::spotAt(ImVec2 place) const {
    for (int pass = 0; pass < int(boxes_.size()); ++pass)
        for (const bool isInput : {true, false})
            for (int wire = 0; wire < int((isInput ? boxes_[std::size_t(pass)].inputs : boxes_[std::size_t(pass)].outputs).size()); ++wire) {
                const Rectangle row = rowOf({isInput, pass, wire});
                const glm::vec2 within = glm::vec2(place.x, place.y) - glm::vec2(row.corner);
                if (within.x >= 0 && within.y >= 0 && within.x < float(row.size.x) && within.y < float(row.size.y)) return Spot{isInput, pass, wire};
            }
    return std::nullopt;
}

int GraphPanel::passAt(ImVec2 place) const {
    for (std::size_t pass = 0; pass < layout_.boxes.size(); ++pass) {
        const ImVec2 low = screen(layout_.boxes[pass].corner), high = screen(layout_.boxes[pass].corner + layout_.boxes[pass].size);
        if (place.x >= low.x && place.y >= low.y && place.x < high.x && place.y < high.y) return int(pass);
    }
    return -1;
}

const WireInfo& GraphPanel::wire(const Spot& spot) const {
    const PassInfo& pass = graph_->passes[std::size_t(spot.pass)];
    return (spot.isInput ? pass.inputs : pass.outputs)[std::size_t(spot.wire)];
}

const EdgeInfo* GraphPanel::edgeInto(const Spot& input) const {
    const auto found = std::ranges::find_if(graph_->edges, [&](const EdgeInfo& edge) { return edge.to == input.pass && edge.input == input.wire; });
    return found == graph_->edges.end() ? nullptr : &*found;
}

const Offer* GraphPanel::offer(const Spot& output, const Spot& input) const {
    if (graph_->edits.offers.empty()) return nullptr;
    const std::vector<Offer>& offers = graph_->edits.offers[std::size_t(input.pass)][std::size_t(input.wire)];
    const auto found = std::ranges::find_if(offers, [&](const Offer& o) { return o.node == output.pass && o.port == wire(output).port; });
    return found == offers.end() ? nullptr : &*found;
}

bool GraphPanel::takesDrag(const Spot& spot) const {
    if (!drag_ || drag_->isInput == spot.isInput) return false;
    return offer(spot.isInput ? *drag_ : spot, spot.isInput ? spot : *drag_) != nullptr;
}

/// Ports first: of two widgets in one place the first gets the mouse.
void GraphPanel::interact(const Rectangle& canvas) {
    const ImGuiIO& io = ImGui::GetIO();
    hovered_.reset();
    for (int pass = 0; pass < int(boxes_.size()); ++pass) {
        for (int i = 0; i < int(boxes_[std::size_t(pass)].inputs.size()); ++i) interactWith({true, pass, i});
        for (int i = 0; i < int(boxes_[std::size_t(pass)].outputs.size()); ++i) interactWith({false, pass, i});
    }
    for (int pass = 0; pass < int(boxes_.size()); ++pass) {
        const PassInfo& info = graph_->passes[std::size_t(pass)];
        const GraphLayout::Box& box = layout_.boxes[std::size_t(pass)];
        ImGui::SetCursorScreenPos(screen(box.corner));
        ImGui::InvisibleButton(("##node " + info.name).c_str(), {std::max(zoomed_ * box.size.x, 1.0f), std::max(zoomed_ * headHeight, 1.0f)});
        mark_("node: " + info.name);
        tip(info.name + ": " + info.type + "\n" + info.doc + "\nright click: switch off, swap, remove");
    }
    ImGui::SetCursorScreenPos({float(canvas.corner.x), float(canvas.corner.y)});
    ImGui::InvisibleButton("##canvas", {float(canvas.size.x), float(canvas.size.y)});
    mark_("graph");
    const bool pulled = ImGui::IsItemActive();
    const bool inside = ImGui::IsWindowHovered(ImGuiHoveredFlags_AllowWhenBlockedByActiveItem) &&
                        ImGui::IsMouseHoveringRect({float(canvas.corner.x), float(canvas.corner.y)},
                                                   {float(canvas.corner.x + canvas.size.x), float(canvas.corner.y + canvas.size.y)});
    hoveredPass_ = inside ? passAt(io.MousePos) : -1;

    constexpr float still = 16;  // square pixels: a click, not a drag
    if (panning_ >= 0 && !io.MouseDown[panning_]) {
        if (panning_ == 1 && io.MouseDragMaxDistanceSqr[1] < still && hoveredPass_ >= 0) {
            menuPass_ = graph_->passes[std::size_t(hoveredPass_)].name;
            ImGui::OpenPopup("pass");
        }
        panning_ = -1;
    }
    for (const int pressed : {1, 2})
        if (inside && panning_ < 0 && ImGui::IsMouseClicked(pressed)) panning_ = pressed;
    const int button = pulled ? 0 : panning_;
    if (button >= 0 && io.MouseDragMaxDistanceSqr[button] >= still) {
        zoom_ = zoomed_;
        centre_ -= glm::vec2(io.MouseDelta.x, io.MouseDelta.y) / zoomed_;
    }
    if (inside && io.MouseWheel != 0) {
        const glm::vec2 pointer = glm::vec2(io.MousePos.x, io.MousePos.y), held = (pointer - origin_) / zoomed_;
        zoom_ = std::clamp(zoomed_ * std::exp2(0.25f * io.MouseWheel), 0.2f, 3.0f);
        place(canvas);
        centre_ += held - (pointer - origin_) / zoomed_;
    }
    if (pulled && ImGui::IsMouseDoubleClicked(0)) fit();
    if (drag_ && !io.MouseDown[0]) drop();
}

void GraphPanel::interactWith(const Spot& spot) {
    const PassInfo& pass = graph_->passes[std::size_t(spot.pass)];
    const std::string name = (spot.isInput ? "in: " : "out: ") + pass.name + "." + wire(spot).name;
    const Rectangle row = rowOf(spot);
    ImGui::SetCursorScreenPos({float(row.corner.x), float(row.corner.y)});
    const bool clicked = ImGui::InvisibleButton(("##" + name).c_str(), {float(row.size.x), float(row.size.y)});
    mark_(name);
    if (ImGui::IsItemActive() && ImGui::IsMouseDragging(0) && !drag_) drag_ = spot;
    if (ImGui::IsItemHovered()) {
        hovered_ = spot;
        if (!drag_) tellOf(spot);
    }
    if (!clicked || drag_ || spot.isInput || pass.off) return;
    // Of a bundle its first member; where that is shown already, the next.
    std::vector<std::string> ports;
    for (const std::string& port : wire(spot).ports)
        if (std::ranges::any_of(graph_->ports, [&](const PortInfo& info) { return info.name == port && !info.fields.empty(); })) ports.push_back(port);
    if (ports.empty()) return;
    const auto now = std::ranges::find(ports, shown_);
    show_(now == ports.end() || now + 1 == ports.end() ? ports.front() : *(now + 1));
}

/// What was dragged from a port is let go.
void GraphPanel::drop() {
    const Spot from = *std::exchange(drag_, std::nullopt);
    const std::optional<Spot> at = spotAt(ImGui::GetIO().MousePos);
    const auto wireFrom = [&](const Spot& input, const std::string& text) {
        send([pass = graph_->passes[std::size_t(input.pass)].name, port = wire(input).name, text](ViewSession& s) { s.wireInput(pass, port, text); });
    };
    if (at && at->isInput != from.isInput) {
        const Spot &output = from.isInput ? *at : from, &input = from.isInput ? from : *at;
        if (const Offer* fitting = offer(output, input)) wireFrom(input, fitting->text);
    } else if (!at && from.isInput) {
        const EdgeInfo* edge = edgeInto(from);
        const bool canBeFree = wire(from).optional || wire(from).kind == WireInfo::Kind::handle;
        if (edge && edge->written && canBeFree) wireFrom(from, "");
    }
}

void GraphPanel::tellOf(const Spot& spot) const {
    const WireInfo& info = wire(spot);
    std::string text = info.doc + "\n" + info.type;
    if (spot.isInput) {
        const EdgeInfo* edge = edgeInto(spot);
        if (edge) {
            const PassInfo& maker = graph_->passes[std::size_t(edge->from)];
            text += "\nfrom " + maker.name + "." + maker.outputs[std::size_t(edge->output)].name + (edge->prev ? ", last frame's" : "") +
                    (edge->written ? "" : ", by itself");
        } else {
            text += info.optional ? "\nunwired, which is fine" : "\nunwired";
        }
    } else {
        for (const std::string& port : info.ports) {
            const auto found = std::ranges::find(graph_->ports, port, &PortInfo::name);
            if (found == graph_->ports.end()) continue;
            text += "\n" + found->name + ": " + found->text + ", " + bytesText(double(found->bytes));
        }
        text += "\nclick: show it; drag: to an input";
    }
    tip(text);
}

}  // namespace lodestir
