// SPDX-License-Identifier: MIT
// Runs a graph frame by frame on a device: allocates what the plan asks for, fills each pass's block, records, submits, times, counts rays.
#pragma once
#include <framework/gpu/commands.h>
#include <framework/graph/graph.h>
#include <framework/graph/plan.h>
#include <framework/graph/probe.h>
#include <framework/graph/ray_body.h>
#include <framework/image/image.h>
#include <framework/shaders/base/frame.h>

#include <array>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace lodestir {

struct RunnerOptions {
    RayBody rays = RayBody::packet;
    std::vector<Source> pinned;  ///< ports to be read after a frame, besides the shown one
    bool checkBounds = false;    ///< count accesses outside a port; Error after the frame
    bool allBarriers = false;    ///< a barrier before every step
    bool keepAll = false;        ///< any port can be read after a frame
    bool shareMemory = false;    ///< ports whose lifetimes don't meet share memory
    bool countSteps = false;     ///< count the nodes that traversal visits (costs time)
    bool probe = false;          ///< compile shaders so that they can tell what happens to a pixel: Runner::probe
    double slice = 0;            ///< milliseconds of work that go to the device at a time, so that others get their turn; 0: a frame is one piece
};

using RayCounts = std::array<std::uint64_t, RAYS_PURPOSES>;

struct PassReport {
    std::string name;
    bool ran = false;         ///< false: an onChange pass with nothing to do
    bool setup = false;       ///< onChange: its time counts as set-up
    double start = 0;         ///< milliseconds on the device since the frame's beginning
    double milliseconds = 0;  ///< on the device
    RayCounts rays{};
};

struct FrameReport {
    std::uint32_t frame = 0;
    double milliseconds = 0;       ///< on the device, of all steps but set-up
    double wholeMilliseconds =
        0;  ///< from the frame's beginning to its end on the device: what is more than its steps went into clearing, barriers and reading back
    std::vector<PassReport> passes;
};

/// What it took to get one shader ready.
struct ShaderReport {
    std::string pass, shader;
    bool cached = false;           ///< SPIR-V came from the disk cache
    double compileMilliseconds = 0;  ///< GLSL to SPIR-V
    double driverMilliseconds = 0;   ///< pipeline creation and first dispatch, where drivers compile
};

class LODESTIR_API Runner {
public:
    /// Device, graph and scene must outlive the runner. Error when memory is out.
    Runner(const gpu::Device& device, Graph& graph, const Scene& scene, RunnerOptions options);
    ~Runner();

    /// Makes the plan's shaders ready, several at once where the driver compiles on the CPU; what isn't ready is made when a frame needs it.
    /// `progress` is told how many of how many are ready.
    void prepare(const std::function<void(std::size_t done, std::size_t all)>& progress);
    /// Runs the next frame and waits for it. Parameters changed since the last frame take effect.
    FrameReport run();
    /// The same, asking shaders what happens to a pixel: what each dispatch told, in order. Only with RunnerOptions::probe.
    std::vector<ProbedDispatch> probe(glm::ivec2 pixel);
    std::uint32_t nextFrame() const;
    void setFrame(std::uint32_t frame);  ///< the number of the next frame; history stays
    void reset();                        ///< history and states are void at the next frame
    void resize(glm::uvec2 size);        ///< reallocates; history is void
    /// Takes over shaders from files that changed; returns how many were made anew. On Error all stay as they were.
    int reloadShaders(std::span<const Path> changed);
    std::vector<Path> shaderFiles() const;  ///< that shaders made ready so far were read from

    /// An image port's content after the last frame (pinned or shown ports only): channels and texels as its format has them.
    ImageData readImage(const Source& source) const;
    /// Memory of a port, to be read between frames; another one may hold it after the next.
    const gpu::Buffer& memoryOf(const Source& source) const;
    /// The bytes of an image or buffer port after the last frame.
    std::vector<std::byte> readBytes(const Source& source) const;

    const Plan& plan() const;
    glm::uvec2 size() const;
    std::size_t memoryBytes() const;                     ///< of ports
    const std::vector<ShaderReport>& shaders() const;    ///< made ready so far

private:
    class State;
    std::unique_ptr<State> state_;
};

}  // namespace lodestir
