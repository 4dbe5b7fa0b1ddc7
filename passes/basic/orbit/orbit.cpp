// SPDX-License-Identifier: MIT
// The scene's camera led around what it looks at.
#include <framework/pass/pass.h>

#include <cmath>
#include <numbers>

using namespace lodestir;

struct Orbit final : Pass {
    In<World>    world{this, "world", "the scene"};
    Out<World>   worldOut{this, "world", "the scene seen from elsewhere: around the point that its camera has in focus"};
    Param<int>   directions{this, "directions", 64, {0, 4096},
                          "frame 0 looks from a corner of a cube, which is farthest from faces and edges, those after it from so many directions less one "
                          "that are spread evenly over the sphere, and then again; 0: from the camera's own, turned"};
    Param<float> turn{this, "turn", 0, {-360, 360}, "without directions: degrees around the vertical axis a frame"};
    Param<float> distance{this, "distance", 1, {0.001f, 1e6f}, "from the point in focus, as a multiple of the camera's"};
    Param<float> recede{this, "recede", 1, {0.1f, 10}, "what the distance grows by a frame, a factor"};
    PassThrough  off{this, world, worldOut};

    void execute(Frame& frame) override {
        World made = frame.valueOf(world);
        CameraRecord& camera = made.camera;
        const glm::vec3 center = camera.position + camera.focus * camera.forward;
        const glm::vec3 from = directions > 0 ? evenly(frame.index()) : turned(-camera.forward, frame.index());
        const glm::vec3 up = std::abs(from.y) > 0.99f ? glm::vec3(0, 0, 1) : glm::vec3(0, 1, 0);
        camera.forward = -from;
        camera.right = glm::length(camera.right) * glm::normalize(glm::cross(camera.forward, up));
        camera.up = glm::length(camera.up) * glm::normalize(glm::cross(camera.right, camera.forward));
        camera.focus *= distance * std::pow(float(recede), float(frame.index()));
        camera.position = center + camera.focus * from;
        frame.provide(worldOut, std::as_bytes(std::span(&made, 1)), nullptr);
    }

private:
    /// A Fibonacci spiral (Swinbank and Purser 2006, Fibonacci grids), after the corner.
    glm::vec3 evenly(std::uint32_t frame) const {
        const int i = int(frame % std::uint32_t(int(directions))), rest = directions - 1;
        if (i == 0) return glm::normalize(glm::vec3(1));
        const float height = 1 - (2 * float(i - 1) + 1) / float(rest), ring = std::sqrt(1 - height * height);
        const float angle = float(i - 1) * 2 * std::numbers::pi_v<float> * (2 - std::numbers::phi_v<float>);
        return {ring * std::cos(angle), height, ring * std::sin(angle)};
    }
    glm::vec3 turned(const glm::vec3& way, std::uint32_t frame) const {
        const float angle = float(frame) * turn * std::numbers::pi_v<float> / 180, c = std::cos(angle), s = std::sin(angle);
        return {c * way.x + s * way.z, way.y, c * way.z - s * way.x};
    }
};
LODESTIR_PASS(Orbit, "", "Leads the scene's camera around the point it has in focus: over a sphere of directions, in steps of an angle, or away from it.")
