// SPDX-License-Identifier: MIT
#include <framework/app/view/comparison_plot.h>

#include <framework/app/view/theme.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace lodestir {
namespace {

/// A box as wide as the window, for one plot.
struct PlotBox {
    explicit PlotBox(float height) : low(ImGui::GetCursorScreenPos()), size(ImGui::GetContentRegionAvail().x, height), list(*ImGui::GetWindowDrawList()) {
        ImGui::Dummy(size);
        list.AddRectFilled(low, {low.x + size.x, low.y + size.y}, IM_COL32(255, 255, 255, 8), 3);
    }
    ImVec2 at(double x, double y) const { return {low.x + float(x) * size.x, low.y + float(1 - y) * size.y}; }

    ImVec2 low, size;
    ImDrawList& list;
};

/// Where a value is between two others, by logarithms.
double share(double value, double low, double high) { return std::log(value / low) / std::log(high / low); }

}  // namespace

ImVec4 colorOfA() { return {0.45f, 0.68f, 0.86f, 1}; }
ImVec4 colorOfB() { return palette().accent; }

void plotErrors(const std::vector<ErrorPoint>& a, const std::vector<ErrorPoint>& b, double ErrorPoint::*metric, float height) {
    const PlotBox box(height);
    double low = std::numeric_limits<double>::max(), high = 0;
    std::uint32_t last = 2;
    for (const auto* curve : {&a, &b})
        for (const ErrorPoint& point : *curve) {
            if (!(point.*metric > 0) || !std::isfinite(point.*metric)) continue;
            low = std::min(low, point.*metric);
            high = std::max(high, point.*metric);
            last = std::max(last, point.frames);
        }
    if (high == 0) return;
    low = std::pow(10, std::floor(std::log10(low)));
    high = std::max(std::pow(10, std::ceil(std::log10(high))), 10 * low);
    const ImU32 line = IM_COL32(255, 255, 255, 22), text = ImGui::GetColorU32(palette().quiet);
    const double step = std::pow(10, std::max(1.0, std::ceil(std::log10(high / low) / 4)));  // four lines are enough
    for (double decade = low; decade < 1.5 * high; decade *= step) {
        const ImVec2 left = box.at(0, share(decade, low, high));
        box.list.AddLine(left, {left.x + box.size.x, left.y}, line);
        box.list.AddText(plainFont(), 12, {left.x + 3, left.y - (decade > low ? 0.0f : 15.0f)}, text, fmt::format("{:.0e}", decade).c_str());
    }
    for (double frames = 10; frames < last; frames *= 10) box.list.AddLine(box.at(share(frames, 1, last), 0), box.at(share(frames, 1, last), 1), line);
    const std::string end = fmt::format("{} frames", last);
    const float width = plainFont()->CalcTextSizeA(12, 1000, 0, end.c_str()).x;
    box.list.AddText(plainFont(), 12, {box.low.x + box.size.x - width - 4, box.low.y + box.size.y - 15}, text, end.c_str());
    const auto draw = [&](const std::vector<ErrorPoint>& curve, const ImVec4& color) {
        std::vector<ImVec2> points;
        for (const ErrorPoint& point : curve)
            if (point.*metric > 0 && std::isfinite(point.*metric)) points.push_back(box.at(share(point.frames, 1, last), share(point.*metric, low, high)));
        box.list.AddPolyline(points.data(), int(points.size()), ImGui::GetColorU32(color), 0, 1.6f);
        if (!points.empty()) box.list.AddCircleFilled(points.back(), 2.6f, ImGui::GetColorU32(color));
    };
    draw(a, colorOfA());
    draw(b, colorOfB());
}

void plotHistograms(const Histograms& histograms, float height) {
    const PlotBox box(height);
    float most = 0;
    for (const std::vector<float>& shares : histograms.shares) most = std::max(most, std::ranges::max(shares));
    if (most <= 0) return;
    const ImVec4 colors[] = {colorOfA(), colorOfB()};
    for (std::size_t side = 0; side < histograms.shares.size(); ++side) {
        const std::vector<float>& shares = histograms.shares[side];
        std::vector<ImVec2> outline;
        for (std::size_t i = 0; i < shares.size(); ++i)
            for (const std::size_t edge : {i, i + 1}) {
                const double tall = 0.92 * std::sqrt(double(shares[i]) / most);  // rare numbers are seen, too
                outline.push_back(box.at(double(edge) / double(shares.size()), tall));
            }
        box.list.AddPolyline(outline.data(), int(outline.size()), ImGui::GetColorU32(colors[side]), 0, 1.4f);
    }
}

}  // namespace lodestir
