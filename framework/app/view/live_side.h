// SPDX-License-Identifier: MIT
// A graph that runs beside the one that is edited: as it was at a moment, with the scene, the camera, the size and the frames of the other.
#pragma once
#include <framework/app/session.h>
#include <framework/app/view/captures.h>
#include <framework/app/view/edit_history.h>

namespace lodestir {

inline constexpr double slice = 20;  ///< RunnerOptions::slice of both sides, so that the window's drawing gets its turn

/// A graph as one side of a comparison runs it.
struct SideGraph {
    Path file;
    HandMade made;       ///< how it differs from its file
    Json whole;          ///< Graph::resolved()
    std::string port;    ///< that is shown; empty: the graph's own
    TexelLayout layout;  ///< what of it; with no port, its first field
};

class LiveSide {
public:
    using Progress = std::function<void(std::size_t done, std::size_t all)>;
    LiveSide(SideGraph graph, const RendererOptions& options, std::shared_ptr<const gpu::Device> device, Progress compiled)
        : side_(std::move(graph)), renderer_(options, std::move(device)), compiled_(std::move(compiled)) {}

    /// Gets ready for the scene and the size of the other side's session. Error where the graph can't be built for them.
    void follow(Session& other);
    /// Follows it, and makes its frame `number`.
    void frame(Session& other, std::uint32_t number, Captures& captures);
    void reset();
    int reloadShaders(std::span<const Path> changed) { return runner_ ? runner_->reloadShaders(changed) : 0; }
    std::vector<Path> shaderFiles() const { return runner_ ? runner_->shaderFiles() : std::vector<Path>(); }
    void save(const Path& folder);  ///< what it shows, as dumpPort() has it: "A.<port>.<frame>"

    const SideGraph& graph() const { return side_; }
    const Picture& picture() const { return picture_; }    ///< no texels: none was made yet
    double milliseconds() const { return milliseconds_; }  ///< of a frame on the device, smoothed

private:
    SideGraph side_;
    Renderer renderer_;
    Progress compiled_;
    std::shared_ptr<Scene> scene_;
    std::unique_ptr<Graph> graph_;
    std::unique_ptr<Runner> runner_;
    PortInfo port_;
    Picture picture_;
    double milliseconds_ = 0;
};

}  // namespace lodestir
