// SPDX-License-Identifier: MIT
// The scene panel's materials and lights: each knob is a parameter of a material_edit or light_edit, which is put in when it is first turned.
#include <framework/app/view/scene_panel.h>

#include <framework/app/view/panel_style.h>
#include <framework/app/view/theme.h>

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace lodestir {

/// To the pass that is there, or to one that will be when the renderer has put it in.
void ScenePanel::sendEdit(const std::string& edit, const ViewSession::SceneEdit& what) {
    if (!edit.empty()) return host_.set(edit + "." + what.parameter, what.value);
    pending_[what.type + what.subject + what.parameter] = what.value;
    send([what](ViewSession& s) { s.editScene(what); });
}

const Value& ScenePanel::valueNow(const std::string& edit, const ViewSession::SceneEdit& what) const {
    if (!edit.empty()) return host_.value(edit + "." + what.parameter);
    const auto pending = pending_.find(what.type + what.subject + what.parameter);
    return pending != pending_.end() ? pending->second : what.value;
}

void ScenePanel::drawKnob(const Knob& knob) {
    const std::string name = knob.what.type + " " + knob.what.subject + "." + knob.what.parameter;
    const Value& now = valueNow(knob.edit, knob.what);
    const bool changed = now != knob.what.value;
    float value = knob.each * (changed ? std::get<float>(now) : knob.shown);
    ImGui::PushID(name.c_str());
    ImGui::AlignTextToFramePadding();
    if (changed)
        ImGui::TextColored(palette().accent, "%s", knob.label);
    else
        ImGui::TextUnformatted(knob.label);
    tip(knob.about);
    ImGui::SameLine(112);
    ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x - 24);
    ViewSession::SceneEdit what = knob.what;
    const bool moved = ImGui::SliderFloat("##value", &value, knob.each * knob.low, knob.each * knob.high, knob.format, ImGuiSliderFlags_AlwaysClamp);
    host_.mark(name);
    tip(knob.about);
    if (moved) {
        what.value = value / knob.each;
        sendEdit(knob.edit, what);
    }
    if (changed) {
        ImGui::SameLine();
        const ImVec2 corner = ImGui::GetCursorScreenPos();
        const float size = ImGui::GetFrameHeight();
        if (ImGui::InvisibleButton("##back", {16, size})) sendEdit(knob.edit, knob.what);
        host_.mark(name + " back");
        ImGui::GetWindowDrawList()->AddCircleFilled({corner.x + 8, corner.y + 0.5f * size}, 4,
                                                    ImGui::GetColorU32(ImGui::IsItemHovered() ? ImVec4(1, 1, 1, 1) : palette().accent));
        tip("as the scene has it");
    }
    ImGui::PopID();
}

void ScenePanel::drawMaterials(const ViewStatus& status) {
    const SceneInfo& info = graph_->contents;
    const SceneState* state = status.sceneState.get();
    ImGui::BeginChild("materials");
    quietText(fmt::format("{} materials; click on the picture to find one", info.materials.size()));
    for (std::size_t m = 0; m < info.materials.size(); ++m) {
        const SceneInfo::Material& material = info.materials[m];
        const bool picked = state && state->picked && state->picked->material == m;
        ImGui::PushID(int(m));
        if (picked) ImGui::PushStyleColor(ImGuiCol_Text, palette().accent);
        if (picked) ImGui::SetNextItemOpen(true, ImGuiCond_Always);
        const bool open = ImGui::CollapsingHeader(material.name.empty() ? fmt::format("material {}", m).c_str() : material.name.c_str());
        if (picked) ImGui::PopStyleColor();
        host_.mark("material: " + material.name);
        const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
        ImGui::GetWindowDrawList()->AddRectFilled(
            {high.x - 26, low.y + 4}, {high.x - 8, high.y - 4},
            ImGui::GetColorU32(ImVec4(std::sqrt(material.baseColor.x), std::sqrt(material.baseColor.y), std::sqrt(material.baseColor.z), 1)), 3);
        if (open && material.name.empty()) {
            quietText("a material without a name can't be changed by itself");
        } else if (open) {
            const auto knob = [&](const char* label, const char* parameter, const char* about, float neutral, float lowest, float highest, float shown) {
                drawKnob({.label = label,
                          .about = about,
                          .edit = material.edit,
                          .what = {.type = "material_edit", .key = "material", .subject = material.name, .parameter = parameter, .value = neutral},
                          .low = lowest,
                          .high = highest,
                          .shown = shown});
            };
            knob("red", "red", "factor on the red of the base colour", 1, 0, 2, 1);
            knob("green", "green", "factor on its green", 1, 0, 2, 1);
            knob("blue", "blue", "factor on its blue", 1, 0, 2, 1);
            knob("roughness", "roughness", "perceptual; its map scales it", -1, 0, 1, material.roughness);
            knob("metal", "metallic", "share of metal; its map scales it", -1, 0, 1, material.metallic);
            if (material.emission != glm::vec3(0))
                knob("emission", "emission", "factor on what it emits; how often it is chosen as a light stays", 1, 0, 20, 1);
        }
        ImGui::PopID();
    }
    ImGui::EndChild();
}

/// In the light's unit, of which the scene gives it so many. What is edited, and goes into the graph, is a factor on that.
void ScenePanel::drawPower(float given, const char* format, const std::string& edit, const ViewSession::SceneEdit& what) {
    const bool dark = given <= 0;
    drawKnob({.label = what.parameter.c_str(),
              .about = dark ? "dark in the scene, whatever the factor" : "up to 20 times what the scene says; 0: it is off",
              .edit = edit,
              .what = what,
              .low = 0,
              .high = 20,
              .shown = 1,
              .each = dark ? 1 : given,
              .format = dark ? "x %.3g" : format});
}

void ScenePanel::drawLights(const ViewStatus&) {
    const SceneInfo& info = graph_->contents;
    ImGui::BeginChild("lights");
    heading("ENVIRONMENT");
    ImGui::SameLine();
    rightText(info.environment);
    const auto environment = [&](const char* label, const char* parameter, const char* about, float neutral, float low, float high) {
        drawKnob({.label = label,
                  .about = about,
                  .edit = info.environmentEdit,
                  .what = {.type = "light_edit", .key = {}, .subject = {}, .parameter = parameter, .value = neutral},
                  .low = low,
                  .high = high,
                  .shown = neutral});
    };
    environment("strength", "environment", "factor on its radiance; 0: it is dark", 1, 0, 4);
    environment("turn", "turn", "degrees around the vertical axis", 0, -180, 180);
    heading(fmt::format("LIGHTS WITHOUT EXTENT  {}", info.lights.size()).c_str());
    for (const SceneInfo::Light& light : info.lights) {
        const ViewSession::SceneEdit what{.type = "light_edit", .key = "light", .subject = light.name, .parameter = "intensity", .value = 1.0f};
        const float now = light.intensity * std::get<float>(valueNow(light.edit, what));
        ImGui::TextUnformatted(light.name.c_str());
        ImGui::SameLine();
        // All around, a candela is 4 pi lumens; how wide a cone is, or the sun's beam, the panel isn't told.
        rightText(light.type == "point" ? fmt::format("point  {:.4g} lm", 4 * std::numbers::pi_v<float> * now) : light.type);
        drawPower(light.intensity, ("%.4g " + light.unit).c_str(), light.edit, what);
    }
    heading("SURFACES THAT EMIT");
    for (const SceneInfo::Material& material : info.materials) {
        if (material.emission == glm::vec3(0) || material.name.empty()) continue;
        ImGui::TextUnformatted(material.name.c_str());
        ImGui::SameLine();
        rightText(fmt::format("{:.3g} {:.3g} {:.3g}", material.emission.x, material.emission.y, material.emission.z));
        drawPower(glm::dot(material.emission, glm::vec3(0.2126f, 0.7152f, 0.0722f)), "%.4g nits", material.edit,
                  {.type = "material_edit", .key = "material", .subject = material.name, .parameter = "emission", .value = 1.0f});
    }
    ImGui::EndChild();
}

}  // namespace lodestir
