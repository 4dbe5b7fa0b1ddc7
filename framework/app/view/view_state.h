// SPDX-License-Identifier: MIT
// What the renderer of a viewer tells its window: plain values, handed over whole, so that neither thread touches what the other works on.
#pragma once
#include <framework/app/view/graph_edit.h>
#include <framework/app/view/scene_state.h>
#include <framework/app/view/texel_values.h>
#include <framework/app/view/told_paths.h>
#include <framework/gpu/buffer.h>
#include <framework/graph/graph.h>
#include <framework/graph/runner.h>
#include <framework/scene/scene.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace lodestir {

/// Something of a port that makes a picture: an image (no name), or a field of a struct that a buffer has for each pixel.
struct PortField {
    std::string name, type;
    TexelLayout layout;
};

struct PortInfo {
    std::string name;  ///< "pass.port"
    std::string doc, text;  ///< text: "rgba32f 960x540", "Buffer<Reservoir> 518400 x 64 B"
    Source source;
    bool runs = false;         ///< false: its pass isn't needed for what is shown, and would be built in when chosen
    glm::uvec2 extent{0};      ///< of the picture; {0, 0}: there is none
    std::size_t bytes = 0;
    std::vector<PortField> fields;
};

/// What one name of a pass wires: a port, or a bundle of them.
struct WireInfo {
    enum class Kind { image, buffer, handle };
    std::string name, type, doc;
    Kind kind = Kind::image;
    bool optional = false;
    int port = -1;                   ///< its number in the pass, or that of the bundle's first
    std::vector<std::string> ports;  ///< of an output: the PortInfos that show it
};

/// An edge of the graph, by numbers of passes and of their inputs and outputs.
struct EdgeInfo {
    int from = -1, output = -1, to = -1, input = -1;
    bool prev = false;
    bool written = false;  ///< false: the graph binds it by itself
};

struct PassInfo {
    std::string name, type, doc;
    bool off = false, culled = false;
    bool canBeOff = false, isScene = false;
    std::vector<Parameter> parameters;  ///< as they are now
    std::vector<Value> given;           ///< what the graph file (or the command line) says
    std::vector<WireInfo> inputs, outputs;
};

/// What edits the graph panel can offer, once it was opened.
struct EditInfo {
    struct Type {
        std::string name, doc;
        std::vector<Question> questions;  ///< before it can be added
    };
    std::vector<Type> types;                                     ///< all that there are
    std::vector<std::vector<std::size_t>> swaps;                 ///< of each pass: types that can take its place
    std::vector<std::vector<std::vector<Offer>>> offers;         ///< of each input of each pass
};

/// What stays the same until a session is built anew.
struct GraphInfo {
    std::string about, scene, device, rays;
    Path file;
    std::vector<std::string> variants;
    std::string variant;  ///< empty: none
    std::string show;     ///< "pass.port" that the graph shows
    glm::uvec2 size{0};
    std::size_t memoryBytes = 0;
    bool software = false;  ///< the device is the CPU
    std::array<glm::vec3, 2> bounds{};
    std::vector<PassInfo> passes;
    std::vector<EdgeInfo> edges;
    std::vector<PortInfo> ports;
    EditInfo edits;
    SceneInfo contents;  ///< of the scene
};

/// A port as it was after a frame.
struct Picture {
    std::shared_ptr<const gpu::Buffer> texels;
    std::string port;       ///< name
    glm::uvec2 extent{0};
    CameraKey camera;       ///< it was taken with
    std::uint32_t frame = 0;
    std::uint64_t number = 0;  ///< tells pictures apart
};

/// What the picture that is made now, B, is compared with.
struct SideA {
    enum class Kind { nothing, kept, image, live };
    Kind kind = Kind::nothing;
    std::string what;         ///< its graph, variant, port and frame, or its file
    Picture picture;          ///< without texels: not made yet
    TexelLayout layout;
    double milliseconds = 0;  ///< of a frame on the device, where it is live
};

/// How far a picture was from another, so many frames after anything was changed.
struct ErrorPoint {
    std::uint32_t frames = 0;
    double mse = 0, relmse = 0;  ///< as image/metrics.h defines them
};

/// How A and B differ.
struct ComparedNumbers {
    std::string reference;         ///< what errors are those against: A, or an image file
    std::string without;           ///< why there are none; empty: there are
    std::vector<ErrorPoint> a, b;  ///< of some frames since anything was changed, rising, the latest last; of A only against an image
    Histograms histograms;         ///< of A and B
};

/// The camera, and whether it is the viewer's own or the scene's.
struct CameraState {
    CameraKey key;
    bool own = false;
};

struct PassTime {
    std::string name;
    bool ran = false, setup = false;
    std::uint64_t runs = 0;   ///< frames in which it ran
    double milliseconds = 0;  ///< smoothed over some frames
    RayCounts rays{};         ///< of the last frame
    /// Of the last frame, whatever they were for.
    double allRays() const {
        double sum = 0;
        for (std::uint32_t purpose = 0; purpose < RAYS_STEPS; ++purpose) sum += double(rays[purpose]);
        return sum;
    }
    std::vector<float> history;  ///< milliseconds of the session's last frames in which it ran, the latest last
};

/// What happened to one pixel of a frame, told by the shaders.
struct PixelTold {
    glm::ivec2 pixel{-1};
    glm::uvec2 size{0};                  ///< of the frame
    std::uint32_t frame = 0, first = 0;  ///< rendered again from the first on
    std::shared_ptr<const nlohmann::ordered_json> passes;  ///< as pixelReport() has them
    std::vector<ToldPath> paths;
};

struct ViewStatus {
    std::shared_ptr<const GraphInfo> graph;  ///< nullptr: nothing was ever built
    std::vector<PassTime> passes;
    double deviceMilliseconds = 0, wallMilliseconds = 0;  ///< of a frame, smoothed
    std::uint32_t nextFrame = 0;
    std::uint64_t framesDone = 0;   ///< since the program began
    std::uint32_t framesStill = 0;  ///< since anything was changed
    std::uint64_t builds = 0, reloads = 0;  ///< sessions built, sets of shaders taken over
    Picture picture;
    CameraState camera;
    std::shared_ptr<const SceneState> sceneState;  ///< while somebody looks at it
    bool paused = false;
    std::string busy;                   ///< what takes long just now; empty: nothing
    std::vector<std::string> problems;  ///< "file:line:column: what; hint"
    std::string refused;                ///< the edit that they are of; empty: they are of files
    std::string undo, redo;             ///< the edits that would be taken back and done again; empty: none
    std::optional<Statistics> statistics;
    std::shared_ptr<const PixelTold> told;  ///< of the pixel that was asked last; nullptr: none
    SideA a;
    std::shared_ptr<const ComparedNumbers> compared;  ///< nullptr: nothing is compared
    std::string note;                   ///< what was done last: "wrote out/display.12.exr"
    std::string failure;                ///< the renderer is finished, and why
};

}  // namespace lodestir
