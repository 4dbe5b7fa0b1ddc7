// SPDX-License-Identifier: MIT
// Where a study's graphs are rendered: one device, one scene at a time, every run in a fresh runner, so that no run knows of another.
#pragma once
#include <framework/graph/runner.h>
#include <framework/scene/scene.h>
#include <framework/study/error/halves.h>
#include <framework/study/run_list.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace lodestir {

/// Most samples of one frame of a reference: frames of a second or so, because long ones are taken for a hang on GPUs that also draw the
/// screen.
inline constexpr std::uint64_t samplesPerFrame = 1 << 23;

struct StageOptions {
    std::vector<Path> passes;  ///< extra folders of pass libraries
    std::string device;        ///< name or index; empty: the best
    std::string rays;          ///< ray body; empty: the fastest
};

/// A graph for one scene, checked, and what is measured of it.
struct StagedGraph {
    Graph graph;
    Source port;  ///< an image in linear radiance
};

struct StagedFrame {
    FrameReport report;
    ImageData image;  ///< three channels
};

class Stage {
public:
    Stage(const Study& study, const StageOptions& options);
    ~Stage();

    /// Builds every graph of the study for every scene, without a device. Error with all that is wrong.
    void check();
    StagedGraph build(const StudyGraph& choice, const std::vector<StudySetting>& knobs, std::size_t scene, std::uint32_t seed);

    const gpu::DeviceFacts& device();  ///< opens the device at the first call, as do the next ones
    RayBody rays();
    const Scene& scene(std::size_t index);  ///< loaded unless it was the last one asked for
    const Hash& sceneContent(std::size_t index);
    /// Hash of all that the frames of a run depend on but the device.
    std::string nameOf(const StudyRun& run);

    /// The reference's graph, taking so many samples a pixel and frame.
    StagedGraph buildReference(std::size_t scene, int samples);
    /// A runner of a graph that was built for the scene; graph and stage must outlive it, and no other scene may be asked for meanwhile.
    std::unique_ptr<Runner> makeRunner(StagedGraph& staged, std::size_t scene);
    /// The measured port after the runner's last frame: three channels. Error when validation had something to say.
    ImageData imageOf(const Runner& runner, const StagedGraph& staged) const;

    /// The measured frames of a run.
    std::vector<StagedFrame> render(const StudyRun& run);
    /// The reference of a measured frame (an offset from the event), from `folder` where it holds one for the same content. `finest`: of the
    /// scene at its finest levels.
    Halves reference(std::size_t scene, int offset, const Path& folder, bool finest = false);
    /// Of each measured frame, the pixels whose centres see an object that takes another level at the event or later, up to the last
    /// measured frame, by the scene's own policy. Error when there is none.
    std::vector<std::vector<bool>> switchedMasks(std::size_t scene);
    /// Of each measured frame, where the frame before showed what it shows: measuredMotions().
    std::vector<ImageData> motions(std::size_t scene);

private:
    ImageData renderHalf(StagedGraph& staged, const std::string& samplesName, std::size_t scene, int frame, std::uint32_t half);
    void open();

    const Study& study_;
    StageOptions options_;
    std::unique_ptr<gpu::Device> device_;
    PluginLibraries libraries_;
    RayBody rays_ = RayBody::lane;
    std::optional<std::size_t> loaded_;
    Scene scene_;
    Hash content_;
};

}  // namespace lodestir
