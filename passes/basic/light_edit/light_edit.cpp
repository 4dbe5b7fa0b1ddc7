// SPDX-License-Identifier: MIT
// Lights changed while everything runs.
#include <framework/pass/pass.h>
#include <framework/pass/scene.h>

#include <algorithm>
#include <numbers>

using namespace lodestir;

struct LightEdit final : Pass {
    In<World> world{this, "world", "the scene"};
    Out<World> worldOut{this, "world", "the scene with its lights changed; how often each is chosen stays as it was"};
    Param<std::string> light{this, "light", "", "name of a light without extent in the scene; empty: all of them"};
    Param<float> intensity{this, "intensity", 1, {0, 1e6f}, "factor on its intensity"};
    Param<float> environment{this, "environment", 1, {0, 1e6f}, "factor on the radiance of the environment"};
    Param<float> turn{this, "turn", 0, {-360, 360}, "degrees that the environment is turned around the vertical axis"};
    PassThrough off{this, world, worldOut};

    /// Lights without extent come behind the triangles that emit, in the scene's order; the environment is the last of those that numbers choose among
    /// (scene/upload/light_list.h).
    void execute(Frame& frame) override {
        const std::vector<Light>& lights = frame.scene().lights;
        const std::string& wanted = light;
        if (!wanted.empty()) namedThing(frame.scene(), lights, wanted, "light", "a light_edit to change");
        World made = frame.valueOf(world);
        const std::uint32_t first = made.lightCount - (made.environmentLight != NONE) - std::uint32_t(lights.size());
        const std::uint32_t texels = environment == 1 ? 0 : made.environmentSize.x * made.environmentSize.y;
        struct Keep {
            Memory lights, environment;
        };
        auto keep = std::make_shared<Keep>();
        keep->lights = frame.allocate(std::max(made.lightRecords, 1u) * sizeof(LightRecord), "lights");
        made.lights = keep->lights.address;
        if (texels > 0) {
            keep->environment = frame.allocate(texels * sizeof(EnvironmentTexel), "environment");
            made.environment = keep->environment.address;
        }
        made.environmentRotation += turn * std::numbers::pi_v<float> / 180;
        frame.provide(worldOut, std::as_bytes(std::span(&made, 1)), keep, std::span<const std::byte>());
        frame.dispatch(shader, {made.lightRecords, 1}, {copies, 0});
        for (std::uint32_t i = 0; i < lights.size(); ++i)
            if (wanted.empty() || lights[i].name == wanted) frame.dispatch(shader, {1, 1}, {scales, first + i});
        frame.dispatch(shader, {texels, 1}, {scalesEnvironment, 0});
    }

private:
    enum Step : std::uint32_t { copies, scales, scalesEnvironment };  // light_edit.comp
};
LODESTIR_PASS(LightEdit, "light_edit.comp",
              "Changes lights of the scene from this frame on: those without extent by a factor, the environment by factor and turn.")
