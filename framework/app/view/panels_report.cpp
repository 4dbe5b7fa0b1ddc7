// SPDX-License-Identifier: MIT
// What the viewer tells: times and rays, facts, problems, the pixel under the pointer, help.
#include <framework/app/view/panels.h>

#include <framework/app/view/panel_style.h>
#include <framework/app/view/theme.h>
#include <framework/graph/ray_purposes.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace lodestir {
namespace {

/// Beside the pointer: the last frames, and how far they lie apart.
void drawHistory(const PassTime& pass) {
    if (pass.history.empty()) return;
    std::vector<float> sorted = pass.history;
    std::ranges::sort(sorted);
    const auto share = [&](double part) { return timeText(sorted[std::size_t(part * double(sorted.size() - 1) + 0.5)]); };
    ImGui::BeginTooltip();
    quietText(fmt::format("{}: ms of the last {} frames, from 0 to {}", pass.name, sorted.size(), share(1)));
    ImGui::PlotLines("##history", pass.history.data(), int(pass.history.size()), 0, nullptr, 0, sorted.back(), {360, 72});
    ImGui::TextUnformatted(fmt::format("median {}   95 % {}   most {}", share(0.5), share(0.95), share(1)).c_str());
    std::string rays;
    for (std::size_t purpose = 0; purpose < RAYS_STEPS; ++purpose)
        if (pass.rays[purpose] > 0)
            rays += fmt::format("{}{} {}", rays.empty() ? "rays: " : "   ", rayPurposes[purpose], countText(double(pass.rays[purpose])));
    if (!rays.empty()) quietText(rays);
    ImGui::EndTooltip();
}

}  // namespace

void Panels::drawTimes(const ViewStatus& status) {
    double most = 0, all = 0, rays = 0;
    for (const PassTime& pass : status.passes) {
        if (pass.setup || !pass.ran) continue;
        most = std::max(most, pass.milliseconds);
        all += pass.milliseconds;
        rays += pass.allRays();
    }
    constexpr ImGuiTableFlags flags = ImGuiTableFlags_RowBg | ImGuiTableFlags_ScrollY | ImGuiTableFlags_SizingFixedFit | ImGuiTableFlags_NoPadOuterX;
    if (!ImGui::BeginTable("passes", 5, flags)) return;
    ImGui::TableSetupScrollFreeze(0, 1);
    ImGui::TableSetupColumn("pass", 0, 130);
    ImGui::TableSetupColumn("time", ImGuiTableColumnFlags_WidthStretch);
    ImGui::TableSetupColumn("ms", 0, 64);
    ImGui::TableSetupColumn("rays", 0, 72);
    ImGui::TableSetupColumn("rays/s", 0, 72);
    const auto number = [](int column, const std::string& text) {
        ImGui::TableSetColumnIndex(column);
        ImGui::PushFont(figureFont());
        rightText(text);
        ImGui::PopFont();
    };
    ImGui::TableNextRow();
    ImGui::PushStyleColor(ImGuiCol_Text, palette().quiet);
    ImGui::TableSetColumnIndex(0);
    ImGui::TextUnformatted("pass");
    number(2, "ms");
    number(3, "rays");
    number(4, "rays/s");
    ImGui::PopStyleColor();
    for (const PassTime& pass : status.passes) {
        ImGui::TableNextRow();
        ImGui::TableSetColumnIndex(0);
        ImGui::Selectable(pass.name.c_str(), false, ImGuiSelectableFlags_SpanAllColumns);
        mark("times of " + pass.name);
        if (ImGui::IsItemHovered()) drawHistory(pass);
        ImGui::TableSetColumnIndex(1);
        if (pass.setup || !pass.ran) {
            quietText(pass.ran ? "set up" : "kept");
        } else {
            const ImVec2 corner = ImGui::GetCursorScreenPos();
            const float width = ImGui::GetContentRegionAvail().x, length = most > 0 ? float(pass.milliseconds / most) * width : 0;
            const float top = corner.y + 5, bottom = corner.y + ImGui::GetTextLineHeight() - 3;
            ImGui::GetWindowDrawList()->AddRectFilled({corner.x, top}, {corner.x + width, bottom}, ImGui::GetColorU32(ImVec4(1, 1, 1, 0.03f)), 2);
            ImGui::GetWindowDrawList()->AddRectFilled({corner.x, top}, {corner.x + std::max(length, 2.0f), bottom}, ImGui::GetColorU32(palette().bar), 2);
        }
        number(2, pass.ran ? timeText(pass.milliseconds) : "");
        const double traced = pass.ran ? pass.allRays() : 0;
        number(3, traced > 0 ? countText(traced) : "");
        number(4, traced > 0 && pass.milliseconds > 0 ? countText(1000 * traced / pass.milliseconds) : "");
    }
    ImGui::TableNextRow();
    ImGui::PushStyleColor(ImGuiCol_Text, palette().accent);
    ImGui::TableSetColumnIndex(0);
    ImGui::TextUnformatted("frame");
    number(2, timeText(all));
    number(3, countText(rays));
    number(4, all > 0 ? countText(1000 * rays / all) : "");
    ImGui::PopStyleColor();
    ImGui::EndTable();
}

void Panels::drawFacts(const ViewStatus& status) {
    const auto fact = [](const char* name, const std::string& value, const std::string& more = {}) {
        quietText(name);
        ImGui::SameLine(86);
        ImGui::TextUnformatted(value.c_str());
        tip(more.empty() ? value : more);
    };
    fact("frame", fmt::format("{}   ({} since a change)", status.nextFrame > 0 ? status.nextFrame - 1 : 0, status.framesStill));
    fact("a frame", fmt::format("{} ms   {:.1f} a second", timeText(status.wallMilliseconds), status.wallMilliseconds > 0 ? 1000 / status.wallMilliseconds : 0),
         "from start to end, with all that the CPU does in between");
    fact("size", fmt::format("{} x {}   zoom {:.0f} %", graph_->size.x, graph_->size.y, 100 * viewport_.zoom()));
    fact("memory",
         bytesText(double(graph_->memoryBytes)) + fmt::format("   {:.0f} B a pixel", double(graph_->memoryBytes) / (double(graph_->size.x) * graph_->size.y)),
         "of the ports");
    fact("rays by", graph_->rays);
    fact("device", graph_->device.substr(0, graph_->device.find(" (")), graph_->device);
    if (graph_->software) quietText("times are the CPU's: rays and ratios\nmean more than milliseconds");
}

void Panels::drawProblems(const ViewStatus& status) {
    const Rectangle area = pictureArea({std::uint32_t(ImGui::GetIO().DisplaySize.x), std::uint32_t(ImGui::GetIO().DisplaySize.y)});
    if (!status.busy.empty() && graph_) {
        ImGui::SetNextWindowPos({float(area.corner.x) + 0.5f * float(area.size.x), float(area.size.y) - 14}, 0, {0.5f, 1});
        ImGui::SetNextWindowBgAlpha(0.85f);
        ImGui::Begin("busy", nullptr, (fixedWindow & ~ImGuiWindowFlags_NoBringToFrontOnFocus) | ImGuiWindowFlags_NoFocusOnAppearing |
                                          ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoInputs);
        ImGui::TextUnformatted((status.busy + " ...").c_str());
        ImGui::End();
    }
    if (status.problems.empty()) return;
    const float width = float(area.size.x) - 32;
    ImGui::SetNextWindowPos({float(area.corner.x) + 16, 16});
    ImGui::SetNextWindowSizeConstraints({width, 0}, {width, float(area.size.y) - 32});
    ImGui::PushStyleColor(ImGuiCol_WindowBg, palette().badBack);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 5);
    ImGui::Begin("problems", nullptr, (fixedWindow & ~ImGuiWindowFlags_NoBringToFrontOnFocus) | ImGuiWindowFlags_AlwaysAutoResize);
    const std::string what = !status.refused.empty() ? "\"" + status.refused + "\" doesn't work; nothing was changed."
                             : graph_                ? "What was saved last doesn't work; what worked before goes on."
                                                     : "This doesn't work yet; it is read again when a file changes.";
    ImGui::TextColored(palette().bad, "%s", what.c_str());
    if (!status.refused.empty()) {
        ImGui::SameLine(width - 76);
        if (button("dismiss", "Close", "Esc")) send([](ViewSession& s) { s.dismiss(); });
    }
    ImGui::PushFont(figureFont());
    ImGui::PushTextWrapPos(width - 14);
    for (const std::string& problem : status.problems) ImGui::TextUnformatted(problem.c_str());
    ImGui::PopTextWrapPos();
    ImGui::PopFont();
    ImGui::End();
    ImGui::PopStyleVar();
    ImGui::PopStyleColor();
}

void Panels::drawProbe(const ViewStatus& status, const std::optional<PicturePainter::Probe>& probe, const Rectangle& area) {
    if (graph_) comparison_.draw(area, pictureName(graph_->file, graph_->variant, status.picture), !graphPanel_.isOpen());
    std::string text = status.picture.texels ? port_ : "";
    if (!status.picture.texels && graph_) text = port_ + ": nothing to look at";
    if (probe && viewport_.pixelUnderPointer().x >= 0) text += "   " + probeText(probe->pixel, probe->bits, probe->layout);
    if (text.empty() || graphPanel_.isOpen()) return;
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    ImGui::PushFont(figureFont());
    const ImVec2 size = ImGui::CalcTextSize(text.c_str()), corner{float(area.corner.x) + 10, float(area.size.y) - size.y - 12};
    list.AddRectFilled({corner.x - 6, corner.y - 4}, {corner.x + size.x + 6, corner.y + size.y + 4}, IM_COL32(12, 13, 15, 200), 3);
    list.AddText(corner, ImGui::GetColorU32(ImGuiCol_Text), text.c_str());
    ImGui::PopFont();
}

void Panels::drawHelp() {
    if (!help_) return;
    static constexpr const char* lines[][2] = {{"left drag", "orbit around the target"},
                                               {"Shift + left drag", "look around"},
                                               {"arrows, Page Up, Down", "fly; with Shift: faster"},
                                               {"right or middle drag", "move sideways"},
                                               {"wheel", "closer, farther"},
                                               {"Ctrl + wheel, Ctrl + drag", "zoom and move the picture"},
                                               {"0   1 2 4 8", "picture as large as fits; zoom"},
                                               {"F   C", "frame the scene; the scene's own camera"},
                                               {"Space   N", "pause; one frame"},
                                               {"R", "restart history and accumulation"},
                                               {"A", "keep what is shown, to compare; let it go"},
                                               {"L", "what runs goes on as A, beside what is edited"},
                                               {"B", "A | B with a line to drag, A, B, A - B"},
                                               {"E", "errors of B, and of A against a reference image"},
                                               {"G", "the graph: its passes and edges, to be edited"},
                                               {"P", "what happened to the pixel under the pointer"},
                                               {"O", "the scene: levels, materials, lights, cameras; a click picks"},
                                               {"Ctrl + Z   Ctrl + Y", "take back what was edited or set; again"},
                                               {"S   Ctrl + S", "save what is shown; edits into the graph's file"},
                                               {"T", "save the last frames' times (CSV, Perfetto)"},
                                               {"F12", "picture of the whole window"},
                                               {"Ctrl + click on a slider", "type the number"},
                                               {"orange dot", "changed; click: back to the graph's value"},
                                               {"H, Esc", "this help"}};
    const ImVec2 window = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({0.5f * (window.x + panelWidth), 0.42f * window.y}, 0, {0.5f, 0.5f});
    ImGui::SetNextWindowSize({560, 0});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 6);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {22, 18});
    ImGui::Begin("help", nullptr, fixedWindow & ~ImGuiWindowFlags_NoBringToFrontOnFocus);
    for (const auto& line : lines) {
        ImGui::TextColored(palette().accent, "%s", line[0]);
        ImGui::SameLine(210);
        ImGui::TextUnformatted(line[1]);
    }
    ImGui::Dummy({0, 4});
    quietText("Graph, scene and shaders are read again when they are saved.");
    ImGui::End();
    ImGui::PopStyleVar(2);
}

}  // namespace lodestir
