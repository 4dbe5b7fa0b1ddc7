// SPDX-License-Identifier: MIT
// How the graph panel draws boxes, ports and edges.
#include <framework/app/view/graph_panel.h>

#include <framework/app/view/graph_panel_style.h>
#include <framework/app/view/panel_style.h>
#include <framework/app/view/theme.h>

#include <algorithm>
#include <cmath>

namespace lodestir {
namespace {

ImU32 color(ImVec4 base, float opacity = 1) {
    base.w *= opacity;
    return ImGui::GetColorU32(base);
}

/// A font that is drawn for that size, so that small text stays sharp.
void addText(ImDrawList& list, ImVec2 corner, float size, ImU32 ink, const std::string& text) {
    list.AddText(plainFont(size), size, {std::round(corner.x), std::round(corner.y)}, ink, text.c_str());
}

/// The line through the corners, with each of them rounded.
std::vector<ImVec2> rounded(const std::vector<ImVec2>& corners, float radius) {
    constexpr int steps = 5;
    std::vector<ImVec2> line{corners.front()};
    for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
        const glm::vec2 before(corners[i - 1].x, corners[i - 1].y), at(corners[i].x, corners[i].y), after(corners[i + 1].x, corners[i + 1].y);
        const float in = glm::length(before - at), out = glm::length(after - at), cut = std::min({radius, 0.5f * in, 0.5f * out});
        const glm::vec2 start = in > 0 ? at + (before - at) * (cut / in) : at, end = out > 0 ? at + (after - at) * (cut / out) : at;
        for (int k = 0; k <= steps; ++k) {
            const float t = float(k) / steps;
            const glm::vec2 p = (1 - t) * (1 - t) * start + 2 * t * (1 - t) * at + t * t * end;
            line.push_back({p.x, p.y});
        }
    }
    line.push_back(corners.back());
    return line;
}

void addDashes(ImDrawList& list, const std::vector<ImVec2>& line, ImU32 ink, float width, float dash) {
    float along = 0;
    for (std::size_t i = 1; i < line.size(); ++i) {
        const glm::vec2 from(line[i - 1].x, line[i - 1].y), step = glm::vec2(line[i].x, line[i].y) - from;
        const float length = glm::length(step);
        for (float at = 0; at < length;) {
            const float phase = std::fmod(along + at, 2 * dash), next = std::min(at + (phase < dash ? dash : 2 * dash) - phase + 1e-3f, length);
            const glm::vec2 a = from + step * (at / length), b = from + step * (next / length);
            if (phase < dash) list.AddLine({a.x, a.y}, {b.x, b.y}, ink, width);
            at = next;
        }
        along += length;
    }
}

void addCurve(ImDrawList& list, ImVec2 from, ImVec2 to, ImU32 ink, float width) {
    const float pull = 0.5f * std::abs(to.x - from.x);
    list.AddBezierCubic(from, {from.x + pull, from.y}, {to.x - pull, to.y}, to, ink, width);
}

}  // namespace

float textWidth(const std::string& text, float size) { return plainFont(size)->CalcTextSizeA(size, 1e6f, 0, text.c_str()).x; }

ImVec4 colorOf(WireInfo::Kind kind) {
    static const ImVec4 colors[] = {{0.47f, 0.68f, 0.87f, 1}, {0.56f, 0.79f, 0.56f, 1}, {0.66f, 0.62f, 0.78f, 1}};
    return colors[int(kind)];
}

/// Those of what is under the pointer come last, over the others.
void GraphPanel::drawEdges(ImDrawList& list) const {
    const auto isPointedAt = [&](const EdgeInfo& edge) {
        if (hovered_) return *hovered_ == Spot{true, edge.to, edge.input} || *hovered_ == Spot{false, edge.from, edge.output};
        return hoveredPass_ >= 0 && (edge.from == hoveredPass_ || edge.to == hoveredPass_);
    };
    for (std::size_t e = 0; e < graph_->edges.size(); ++e)
        if (!isPointedAt(graph_->edges[e])) drawEdge(list, e, false);
    for (std::size_t e = 0; e < graph_->edges.size(); ++e)
        if (isPointedAt(graph_->edges[e])) drawEdge(list, e, true);
}

void GraphPanel::drawEdge(ImDrawList& list, std::size_t e, bool bright) const {
    const EdgeInfo& edge = graph_->edges[e];
    const auto isIdle = [&](int pass) { return graph_->passes[std::size_t(pass)].off || graph_->passes[std::size_t(pass)].culled; };
    const WireInfo::Kind kind = wire({true, edge.to, edge.input}).kind;
    const bool isDragged = drag_ && *drag_ == Spot{true, edge.to, edge.input};
    const float opacity = isDragged ? 0.15f : bright ? 1 : isIdle(edge.to) ? 0.3f : kind == WireInfo::Kind::handle ? 0.45f : 0.7f;
    const ImU32 ink = color(colorOf(kind), opacity);
    const float width = (bright ? 2.4f : 1.5f) * std::max(zoomed_, 0.7f);
    std::vector<ImVec2> points;
    for (const glm::vec2 point : layout_.routes[e].points) points.push_back(screen(point));
    if (layout_.routes[e].back) return addDashes(list, rounded(points, 7 * zoomed_), ink, width, 5 * std::max(zoomed_, 0.6f));
    for (std::size_t i = 1; i < points.size(); ++i) {
        if (i % 2 == 1)
            addCurve(list, points[i - 1], points[i], ink, width);
        else
            list.AddLine(points[i - 1], points[i], ink, width);
    }
}

void GraphPanel::drawBox(ImDrawList& list, const ViewStatus& status, int pass) const {
    const PassInfo& info = graph_->passes[std::size_t(pass)];
    const GraphLayout::Box& box = layout_.boxes[std::size_t(pass)];
    const bool idle = info.off || info.culled;
    const bool isShown = shown_.starts_with(info.name + ".");
    const ImVec2 low = screen(box.corner), high = screen(box.corner + box.size);
    const float z = zoomed_, left = low.x + boxPadding * z;
    list.AddRectFilled(low, high, color(idle ? idleBack : boxBack), 5 * z);
    const ImVec4 rim = hoveredPass_ == pass ? palette().quiet : boxEdge;
    list.AddRect(low, high, color(isShown ? palette().accent : rim, isShown ? 0.9f : 1), 5 * z, 0, isShown ? 1.6f : 1.0f);
    const ImU32 quiet = color(palette().quiet, idle ? 0.75f : 1);
    addText(list, {left, low.y + 6 * z}, nameSize * z, idle ? quiet : ImGui::GetColorU32(ImGuiCol_Text), info.name);
    addText(list, {left, low.y + 24 * z}, smallSize * z, quiet, info.type);

    // Its time in the frame, as in the strip below, and as a bar against the longest.
    const auto time = std::ranges::find(status.passes, info.name, &PassTime::name);
    double most = 0;
    for (const PassTime& other : status.passes)
        if (other.ran && !other.setup) most = std::max(most, other.milliseconds);
    const bool measured = time != status.passes.end() && !idle;
    std::string text = info.off ? "off" : info.culled ? "not needed" : "", rays;
    if (measured && !time->ran) text = "kept";
    if (measured && time->ran) {
        text = time->setup ? "set up " : "";
        text += timeText(time->milliseconds) + " ms";
        if (time->allRays() > 0) rays = countText(time->allRays()) + " rays";
        const float y = low.y + 54 * z, right = high.x - boxPadding * z, length = most > 0 ? float(std::min(time->milliseconds / most, 1.0)) : 0;
        list.AddRectFilled({left, y}, {right, y + 2.5f * z}, color({1, 1, 1, 0.06f}));
        if (!time->setup) list.AddRectFilled({left, y}, {left + std::max(length * (right - left), 1.0f), y + 2.5f * z}, color(palette().bar));
    }
    addText(list, {left, low.y + 39 * z}, timeSize * z, info.off ? color(palette().accent, 0.8f) : quiet, text);
    addText(list, {high.x - boxPadding * z - textWidth(rays, timeSize * z), low.y + 39 * z}, timeSize * z, quiet, rays);
    for (int i = 0; i < int(info.inputs.size()); ++i) drawPort(list, {true, pass, i});
    for (int i = 0; i < int(info.outputs.size()); ++i) drawPort(list, {false, pass, i});
}

void GraphPanel::drawPort(ImDrawList& list, const Spot& spot) const {
    const WireInfo& info = wire(spot);
    const PassInfo& pass = graph_->passes[std::size_t(spot.pass)];
    const bool idle = pass.off || pass.culled, isShown = !spot.isInput && std::ranges::find(info.ports, shown_) != info.ports.end();
    const bool fits = takesDrag(spot), unwired = spot.isInput && !edgeInto(spot);
    const bool dim = drag_ ? !fits && *drag_ != spot : idle || unwired;
    const ImVec2 dot = dotOf(spot);
    const float z = zoomed_, radius = dotRadius * z * (fits ? 1.5f : 1);
    if (fits || isShown || (hovered_ && *hovered_ == spot)) {
        const Rectangle row = rowOf(spot);
        const GraphLayout::Box& box = layout_.boxes[std::size_t(spot.pass)];
        const float left = screen(box.corner).x, right = screen(box.corner + box.size).x, top = float(row.corner.y);
        list.AddRectFilled({left + 1, top}, {right - 1, top + rowHeight * z},
                           color(fits || isShown ? palette().accent : ImVec4(1, 1, 1, 1), fits ? 0.22f : 0.1f));
    }
    const ImU32 ink = color(isShown ? palette().accent : colorOf(info.kind), dim ? 0.5f : 1);
    if (unwired && !fits) {
        list.AddCircleFilled(dot, radius, color(idleBack));
        list.AddCircle(dot, radius, ink, 0, 1.2f);
    } else {
        list.AddCircleFilled(dot, radius, ink);
    }
    const float size = portSize * z, y = dot.y - 0.56f * size;
    const ImU32 text = isShown ? color(palette().accent) : dim ? color(palette().quiet, 0.85f) : ImGui::GetColorU32(ImGuiCol_Text);
    addText(list, {spot.isInput ? dot.x + boxPadding * z : dot.x - boxPadding * z - textWidth(info.name, size), y}, size, text, info.name);
}

void GraphPanel::drawDrag(ImDrawList& list) const {
    if (!drag_) return;
    const std::optional<Spot> at = spotAt(ImGui::GetIO().MousePos);
    const ImVec2 dot = dotOf(*drag_), end = at && takesDrag(*at) ? dotOf(*at) : ImGui::GetIO().MousePos;
    const ImU32 ink = color(palette().accent);
    if (drag_->isInput)
        addCurve(list, end, dot, ink, 2);
    else
        addCurve(list, dot, end, ink, 2);
    list.AddCircleFilled(end, 4, ink);
}

}  // namespace lodestir
