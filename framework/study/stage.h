// SPDX-License-Identifier: MIT
// Where a study's graphs are rendered: one device, one scene at a time, every run with a history that is void, so that no run knows of another.
#pragma once
#include <framework/graph/renderer.h>
#include <framework/scene/scene.h>
#include <framework/study/error/seen.h>
#include <framework/study/kept_runners.h>
#include <framework/study/run_list.h>
#include <framework/study/workers.h>

#include <array>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace lodestir {

/// Most samples of one frame of a reference: frames of a second or so, because long ones are taken for a hang on GPUs that also draw the
/// screen.
inline constexpr std::uint64_t samplesPerFrame = 1 << 23;

struct StagedFrame {
    FrameReport report;
    ImageData image;  ///< three channels
    std::map<std::string, double> counts;
};

/// One of the two independent images that a reference is made of.
struct ReferenceHalf {
    std::size_t scene = 0;
    int frame = 0;  ///< of the scene
    bool finest = false;
    std::uint32_t index = 0;  ///< 0: A, 1: B
    Path file;
};

class Stage {
public:
    /// Without a device it opens one of its own.
    Stage(const Study& study, const RendererOptions& options, std::shared_ptr<const gpu::Device> device = {});
    ~Stage();

    /// Builds every graph of the study for every scene, without a device. Error with all that is wrong.
    void check();
    StagedGraph build(const StudyGraph& choice, const std::vector<Setting>& knobs, std::size_t scene, std::uint32_t seed);

    const gpu::DeviceFacts& device() { return renderer_.device().facts(); }
    RayBody rays() { return renderer_.rays(); }
    WorkDevice workDevice() { return {device().name, device().type == "cpu"}; }
    const Scene& scene(std::size_t index);  ///< loaded unless it was the last one asked for
    const Hash& sceneContent(std::size_t index);
    /// Hash of all that the frames of a run depend on but the device.
    std::string nameOf(const StudyRun& run);

    /// The reference's graph, taking so many samples a pixel and frame.
    StagedGraph buildReference(std::size_t scene, int samples);
    /// A runner of a graph that was built for the scene; graph and stage must outlive it, and no other scene may be asked for meanwhile.
    std::unique_ptr<Runner> makeRunner(StagedGraph& staged, std::size_t scene);
    /// The measured port after the runner's last frame: three channels. Error when validation had something to say.
    ImageData imageOf(const Runner& runner, const StagedGraph& staged);

    /// The measured frames of a run.
    std::vector<StagedFrame> render(const StudyRun& run);
    /// A mask's port in the measured frames: its channels as they are.
    std::vector<ImageData> renderMask(const StudyGraph& graph, std::size_t scene);
    /// The halves of the reference of a measured frame (an offset from the event), named by their content. `finest`: of the scene at its finest levels.
    std::array<ReferenceHalf, 2> referenceHalves(std::size_t scene, int offset, const Path& folder, bool finest);
    /// Renders one, and writes its file.
    void makeHalf(const ReferenceHalf& half);
    /// What is seen in the measured frames besides radiance.
    Seen see(std::size_t scene);

private:
    /// A technique's graph, with the ports of the study's counters.
    StagedGraph buildTechnique(const Technique& technique, const std::vector<Setting>& knobs, std::size_t scene, std::uint32_t seed);
    /// What is counted of the runner's last frame.
    std::map<std::string, double> countsOf(const Runner& runner, const StagedGraph& staged, const FrameReport& report, std::size_t scene) const;
    /// Runs a graph from the warm-up to the last measured frame; `take` reads the measured ones.
    void runFrames(Runner& runner, const std::vector<int>& clear, const std::function<void(FrameReport&)>& take);
    Hash contentOf(const StudyRun& run);
    int samplesAFrame(const Graph& graph) const;  ///< of a reference, at most
    ImageData renderHalf(StagedGraph& staged, const ReferenceHalf& half);

    const Study& study_;
    Renderer renderer_;
    std::optional<std::size_t> loaded_;
    Scene scene_;
    Hash content_;
    std::map<std::string, Hash> contents_;  ///< of configurations
    KeptRunners runners_;  ///< of that scene; behind what they are made of
};

}  // namespace lodestir
