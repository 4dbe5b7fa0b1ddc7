// SPDX-License-Identifier: MIT
// A graph brought to life: its passes loaded, its scene read, its runner on a device. What every command that renders starts from.
#pragma once
#include <framework/graph/renderer.h>
#include <framework/scene/scene.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace lodestir {

class Command;

/// Adds the options of all that renders: --passes, --device, --rays.
void addRendererOptions(Command& command, RendererOptions& options);

/// "960x540", given to an option. Wrong use naming the option when it is none.
glm::uvec2 readSize(const std::string& option, const std::string& text);

struct SessionOptions {
    Path graph;
    GraphOptions changes;
    RendererOptions renderer;
    std::vector<std::string> dumps;  ///< ports to be read after a frame
    bool checkBounds = false, allBarriers = false, shareMemory = false, countSteps = false;

    /// Adds the options that say what is rendered on what.
    void addGraph(Command& command);
    /// These, and the others that all commands share which render one frame after the other.
    void addTo(Command& command);
};

/// What a session may take over from another instead of making it.
struct SessionParts {
    std::shared_ptr<const gpu::Device> device;
    std::shared_ptr<Scene> scene;        ///< where it is of the graph's scene file
    std::function<void(Graph&)> adjust;  ///< sets parameters before anything is made of the graph
    double slice = 0;                    ///< RunnerOptions::slice
    bool keepAll = false;                ///< RunnerOptions::keepAll
    bool probe = false;                  ///< RunnerOptions::probe; what ports hold of pixels can be read, too
    /// Told how many of how many shaders are ready; empty: a line of progress on stderr.
    std::function<void(std::size_t done, std::size_t all)> compiled;
};

class Session {
public:
    explicit Session(const SessionOptions& options, SessionParts parts = {});

    const gpu::Device& device() { return renderer_.device(); }
    Graph& graph() { return *graph_; }
    const Scene& scene() const { return *scene_; }
    const std::shared_ptr<Scene>& sharedScene() const { return scene_; }
    Runner& runner() { return *runner_; }
    const std::vector<Source>& dumps() const { return dumps_; }
    RayBody rays() { return renderer_.rays(); }
    double sceneMilliseconds() const { return sceneMilliseconds_; }  ///< to read the scene

private:
    Renderer renderer_;  // first, because passes may hold its device's memory
    std::unique_ptr<Graph> graph_;
    std::vector<Source> dumps_;
    std::shared_ptr<Scene> scene_;
    std::unique_ptr<Runner> runner_;
    double sceneMilliseconds_ = 0;
};

}  // namespace lodestir
