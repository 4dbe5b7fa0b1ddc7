// SPDX-License-Identifier: MIT
// A graph brought to life: its passes loaded, its scene read, its runner on a device. What every command that renders starts from.
#pragma once
#include <framework/graph/runner.h>
#include <framework/scene/scene.h>

#include <memory>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace lodestir {

struct SessionOptions {
    Path graph;
    GraphOptions changes;
    std::vector<Path> passes;         ///< extra folders of pass libraries
    std::vector<std::string> dumps;   ///< ports to be read after a frame
    std::string device;               ///< name or index; empty: the best
    std::string rays;                 ///< ray body; empty: the fastest
    bool checkBounds = false, allBarriers = false, countSteps = false;

    /// Adds the options that all rendering commands share.
    void addTo(CLI::App& command);
};

class Session {
public:
    explicit Session(const SessionOptions& options);

    const gpu::Device& device() const { return *device_; }
    Graph& graph() { return *graph_; }
    const Scene& scene() const { return scene_; }
    Runner& runner() { return *runner_; }
    const std::vector<Source>& dumps() const { return dumps_; }
    RayBody rays() const { return rays_; }
    double sceneMilliseconds() const { return sceneMilliseconds_; }  ///< to read the scene

private:
    std::unique_ptr<gpu::Device> device_;  // first, because passes may hold its memory
    PluginLibraries libraries_;
    std::unique_ptr<Graph> graph_;
    std::vector<Source> dumps_;
    Scene scene_;
    RayBody rays_ = RayBody::lane;
    std::unique_ptr<Runner> runner_;
    double sceneMilliseconds_ = 0;
};

}  // namespace lodestir
