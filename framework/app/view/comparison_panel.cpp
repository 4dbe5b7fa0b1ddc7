// SPDX-License-Identifier: MIT
#include <framework/app/view/comparison_panel.h>

#include <framework/app/view/comparison_plot.h>
#include <framework/app/view/panel_style.h>
#include <framework/app/view/theme.h>

#include <fmt/format.h>

#include <tuple>
#include <utility>

namespace lodestir {
namespace {

constexpr float width = 300, margin = 10;  // pixels

std::string errorText(double error) { return fmt::format("{:#.4g}", error); }

}  // namespace

void ComparisonPanel::draw(const ViewStatus& status, const Rectangle& area) {
    const bool compares = status.a.kind != SideA::Kind::nothing;
    if (compares != std::exchange(compares_, compares)) open_ = compares;
    if (!open_ || !status.graph) return;
    ImGui::SetNextWindowPos({float(area.corner.x + area.size.x) - margin, float(area.corner.y + area.size.y) - margin}, 0, {1, 1});
    ImGui::SetNextWindowSize({width, 0});
    ImGui::SetNextWindowBgAlpha(0.88f);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 5);
    ImGui::Begin("comparison", nullptr, (fixedWindow & ~ImGuiWindowFlags_NoBringToFrontOnFocus) | ImGuiWindowFlags_NoFocusOnAppearing);
    drawSides(status);
    if (status.compared) drawErrors(*status.compared);
    drawStudy();
    ImGui::End();
    ImGui::PopStyleVar();
}

void ComparisonPanel::drawSides(const ViewStatus& status) {
    const auto side = [](const char* name, const ImVec4& color, const std::string& what, double milliseconds) {
        ImGui::TextColored(color, "%s", name);
        ImGui::SameLine(0, 8);
        const float space = milliseconds > 0 ? 64.0f : 0.0f, end = ImGui::GetCursorScreenPos().x + ImGui::GetContentRegionAvail().x - space;
        ImGui::PushClipRect(ImGui::GetCursorScreenPos(), {end, 1e6f}, true);
        ImGui::TextUnformatted(what.c_str());
        ImGui::PopClipRect();
        tip(what);
        if (milliseconds <= 0) return;
        ImGui::SameLine();
        ImGui::SetCursorScreenPos({end, ImGui::GetCursorScreenPos().y});
        rightText(timeText(milliseconds) + " ms");
    };
    if (status.a.kind == SideA::Kind::nothing) side("A", colorOfA(), "nothing yet", 0);
    else side("A", colorOfA(), status.a.what, status.a.milliseconds);
    side("B", colorOfB(), pictureName(status.graph->file, status.graph->variant, status.picture), status.deviceMilliseconds);
    if (status.a.kind == SideA::Kind::image) {
        if (ImGui::Button("let the image go", {-1, 0})) send([](ViewSession& s) { s.releaseA(); });
        mark_("let the image go");
    }
    if (status.graph->variants.empty()) return;
    ImGui::SetNextItemWidth(-1);
    if (ImGui::BeginCombo("##variants", "run a variant as A")) {
        const auto choice = [&](const std::string& label, const std::optional<std::string>& variant) {
            if (ImGui::Selectable(label.c_str())) send([file = status.graph->file, variant](ViewSession& s) { s.runAsA(file, variant); });
            mark_("A: " + label);
        };
        choice("the graph as written", {});
        for (const std::string& variant : status.graph->variants) choice(variant, variant);
        ImGui::EndCombo();
    }
    mark_("variants of A");
    tip("of the graph's file, beside what is edited: same camera, same frames");
}

void ComparisonPanel::drawErrors(const ComparedNumbers& numbers) {
    ImGui::Dummy({0, 2});
    quietText("errors against " + numbers.reference);
    tip("since anything was changed");
    if (!numbers.without.empty()) {
        ImGui::TextWrapped("none: %s", numbers.without.c_str());
    } else {
        const auto row = [&](const char* name, double ErrorPoint::*metric, bool chosen, const char* about) {
            if (ImGui::Selectable(name, chosen, 0, {66, 0})) plotsMse_ = metric == &ErrorPoint::mse;
            mark_(name);
            tip(std::string(about) + "\nclick: in the plot");
            ImGui::PushFont(figureFont());
            for (const auto& [curve, color, x] : {std::tuple(&numbers.a, colorOfA(), 104.0f), std::tuple(&numbers.b, colorOfB(), 196.0f)}) {
                if (curve->empty()) continue;
                ImGui::SameLine(x);
                ImGui::TextColored(color, "%s", errorText(curve->back().*metric).c_str());
            }
            ImGui::PopFont();
        };
        row("RelMSE", &ErrorPoint::relmse, !plotsMse_, "squared errors, each by its pixel's mean: `relmse` of lodestir compare");
        row("MSE", &ErrorPoint::mse, plotsMse_, "squared errors: `mse` of lodestir compare");
        plotErrors(numbers.a, numbers.b, plotsMse_ ? &ErrorPoint::mse : &ErrorPoint::relmse, 96);
    }
    ImGui::Dummy({0, 1});
    plotHistograms(numbers.histograms, 56);
    tip("how the shown numbers of A and B are distributed; of colours their luminance; heights are square roots");
    ImGui::PushStyleColor(ImGuiCol_Text, palette().quiet);
    ImGui::TextUnformatted(fmt::format("{:.3g}", numbers.histograms.low).c_str());
    ImGui::SameLine();
    rightText(fmt::format("{:.3g}", numbers.histograms.high));
    ImGui::PopStyleColor();
}

void ComparisonPanel::drawStudy() {
    if (ImGui::Button("Make a study of this", {-1, 0})) send([folder = out_ / "study"](ViewSession& s) { s.makeStudy(folder); });
    mark_("make a study");
    tip("a file for `lodestir study`: A and B as techniques, this scene through this camera, a path tracer as the reference");
}

}  // namespace lodestir
