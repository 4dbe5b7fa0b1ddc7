// SPDX-License-Identifier: MIT
// All that the author of a technique has to know. A pass is a struct whose members are its ports and parameters:
//
//     struct Bloom final : Pass {
//         In<Image>    color{this, "color", "scene-linear radiance"};
//         Out<Image>   glow{this, "glow", "blurred highlights", Format::rgba16f, {.scale = 0.5f}};
//         Param<float> knee{this, "knee", 1.0f, {0, 10}, "luminance below which nothing blooms"};
//     };
//     LODESTIR_PASS(Bloom, "bloom.comp", "Gaussian of the highlights, at half resolution.")
//
// The shader starts with #include "pass.glsl", which is made from this declaration. Buffers that always travel together are one port (bundle.h);
// parameters that passes share are one member (parameter.h). A pass sees this header, framework/pass/scene.h and image.h beside it, what is shared
// with shaders, and the families of passes; nothing else of the framework is on its include path.
#pragma once
#include <framework/core/error.h>  // what execute() throws
#include <framework/pass/bundle.h>
#include <framework/pass/parameter.h>
#include <framework/pass/port.h>
#include <framework/shaders/world/ray.h>
#include <framework/shaders/world/world.h>

#include <cstring>
#include <functional>
#include <initializer_list>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace lodestir {

/// Passes that choose levels take a World and make one.
template <> inline constexpr bool isChained<World> = true;

struct Hash;          // framework/pass/scene.h
struct Scene;         // the same
struct SceneRecords;  // the same

/// When a pass runs: every frame, or only when an input's content or a parameter changed (its time then counts as set-up).
enum class Cadence : std::uint8_t { everyFrame, onChange };

/// Memory on the device that a pass made: what handle outputs point to. It lives as long as a copy of `keep`, and until the frame is
/// done in which it was made.
struct Memory {
    std::uint64_t address = 0;  ///< what LODESTIR_ARRAY_OF members of shared structs hold
    std::shared_ptr<const void> keep;
};

/// Memory whose content outlives the program.
struct KeptMemory {
    Memory memory;
    bool isFilled = false;  ///< with what an earlier run left; else this execute() has to fill it
};

/// What a pass can do while it executes.
class LODESTIR_API Frame {
public:
    virtual ~Frame() = default;
    virtual std::uint32_t index() const = 0;          ///< frame number, from 0
    virtual std::uint32_t seed() const = 0;           ///< of all random numbers of the run
    virtual glm::uvec2 size() const = 0;              ///< of the frame, pixels
    virtual bool historyValid() const = 0;            ///< false at start and after resize, cut and reset
    virtual glm::uvec2 sizeOf(const Port& port) const = 0;      ///< of an image, pixels
    virtual std::uint32_t countOf(const Port& port) const = 0;  ///< elements of a buffer
    virtual bool isBound(const Port& port) const = 0;
    bool isBound(const BundlePort& port) const { return isBound(port.members.front()); }
    virtual std::span<const std::byte> bytesOf(const Port& port) const = 0;  ///< of the struct that a wired handle input holds
    template <class R> R valueOf(const In<R>& port) const {
        R value;
        std::memcpy(&value, bytesOf(port).data(), sizeof value);
        return value;
    }
    /// Runs a shader of this pass's folder once for each element of `extent` (pixels, or {n, 1}). A shader that includes
    /// "trace/driver.glsl" is spread as its tracing body likes best. `arguments`: up to 4 words, argument(i) in the shader.
    /// Dispatches of one pass see what earlier ones wrote.
    virtual void dispatch(std::string_view shader, glm::uvec2 extent, std::initializer_list<std::uint32_t> arguments = {}) = 0;
    /// Fills a port this pass makes with a 32-bit word.
    virtual void fill(const Port& port, std::uint32_t word) = 0;
    /// Memory for so many elements of a scratch buffer that is declared with Count::reserved(); before anything of this execute() is recorded.
    virtual void reserve(const Port& port, std::uint32_t elements) = 0;
    void reserve(const BundlePort& port, std::uint32_t elements) {
        for (const Port& member : port.members) reserve(member, elements);
    }
    /// Fills a buffer or image this pass makes with `bytes` from the CPU (at most its size).
    virtual void upload(const Port& port, std::span<const std::byte> bytes) = 0;
    /// New memory that holds `bytes`. `name` shows in debuggers.
    virtual Memory upload(std::span<const std::byte> bytes, const std::string& name) = 0;
    template <class T> Memory upload(const std::vector<T>& values, const std::string& name) { return upload(std::as_bytes(std::span(values)), name); }
    /// New memory for this execute() to fill.
    virtual Memory allocate(std::size_t bytes, const std::string& name) = 0;
    /// The same for what takes long to make: when the frame is done its content goes to the cache on disk, where a later run finds it by `key`, the
    /// shaders of this pass, the device and the ray body. `key` has to cover all else that the content depends on. Damaged files count as none.
    virtual KeptMemory kept(const Hash& key, std::size_t bytes, const std::string& name) = 0;
    /// Gives a handle output its struct; `keep` owns the memory that the struct points to and lives as long as the value is used (also as @prev).
    /// Whether it is another than last frame's (accumulation starts again, and who runs on change runs) is told by its bytes, or, where these hold memory
    /// that is new each frame or random numbers, by `meaning`: beside parameters and inputs of this frame all that it depends on.
    virtual void provide(const Port& port, std::span<const std::byte> value, std::shared_ptr<const void> keep,
                         std::optional<std::span<const std::byte>> meaning = {}) = 0;
    /// Gives an output the World of the loaded scene as it stands at a frame (fractions are fine), seen while the shutter is open for so many frames from
    /// there on; shaders see that where a Fact of the pass defines MOTION_BLUR.
    virtual void provideScene(const Port& world, float at, float shutter) = 0;
    /// Where a World lies that holds each mesh of the scene by itself: instance m is mesh m, untransformed, at its finest level, in the pose that the World
    /// of a wired input has, or of frame 0 where the input is unwired. There is no top level over them and no light: rays are traced in
    /// onlyInstance(w, m) (trace/reference.glsl). What comes next in this pass sees it, and sceneRecords() is of that pose.
    virtual Memory objects(const In<World>& posed) = 0;
    virtual const Scene& scene() const = 0;
    virtual SceneRecords sceneRecords() const = 0;  ///< lives as long as the scene
};

/// World.frameKey of a frame, by which its pixels draw numbers; the meaning of such a World (Frame::provide) is what it is without.
inline std::uint32_t frameKey(const Frame& frame) { return frame.seed() * 0x9e3779b9u + frame.index() * 0x85ebca6bu; }

class LODESTIR_API Pass {
public:
    std::vector<Port*> ports;            ///< filled by the members of the derived struct, in order of declaration
    std::vector<Parameter*> parameters;
    Cadence cadence = Cadence::everyFrame;
    bool restartOnChange = false;        ///< State is cleared whenever any parameter of the graph changes (accumulation)
    bool forDisplay = false;             ///< what it makes is for eyes: errors are measured in what it hands through when off (tone mapping)
    struct Bypass {
        const Port* in;
        const Port* out;
    };
    std::vector<Bypass> bypasses;        ///< with "off": true each out is its in; a pass without any can't be off
    std::vector<Bypass> overwrites;      ///< outs that may lie in the memory of their ins
    struct MacroOfGraph {
        std::string_view macro;
        const Port* in;                           ///< null: `holds` says
        std::function<bool(const Scene&)> holds;  ///< by the parameters as they are
    };
    std::vector<MacroOfGraph> facts;     ///< macros that all shaders of a graph are compiled with as 1 where the input is wired, or where they hold

    Pass();
    Pass(const Pass&) = delete;
    Pass& operator=(const Pass&) = delete;
    virtual ~Pass();                     // rule: constructing a pass never touches the GPU
    /// Default: dispatches the shader of LODESTIR_PASS over the first output: an image's pixels, the frame's pixels where it is a buffer
    /// with elements per pixel, else the buffer's elements.
    virtual void execute(Frame& frame);
    std::string_view shader;             ///< set from LODESTIR_PASS
};

/// Declares that a pass with "off": true hands `in` through as `out`.
struct LODESTIR_API PassThrough {
    PassThrough(Pass* pass, const Port& in, const Port& out) { pass->bypasses.push_back({&in, &out}); }
    template <Bundle B> PassThrough(Pass* pass, const In<B>& in, const Out<B>& out) {
        for (std::size_t i = 0; i < in.members.size(); ++i) pass->bypasses.push_back({&in.members[i], &out.members[i]});
    }
};

/// Declares that `out` may be written over `in`, where nobody else needs `in` any more: each invocation reads of it the element that it writes, and reads
/// it before. The graph's plan decides.
struct LODESTIR_API InPlace {
    InPlace(Pass* pass, const Port& in, const Port& out) { pass->overwrites.push_back({&in, &out}); }
    template <Bundle B> InPlace(Pass* pass, const In<B>& in, const Out<B>& out) {
        for (std::size_t i = 0; i < in.members.size(); ++i) pass->overwrites.push_back({&in.members[i], &out.members[i]});
    }
};

/// Declares that where `in` is wired, or where `holds` says so, all shaders of the graph are compiled with a macro as 1: of what graphs can do that few of
/// them do, and others shouldn't pay for.
struct LODESTIR_API Fact {
    Fact(Pass* pass, std::string_view macro, const Port& in) { pass->facts.push_back({macro, &in, {}}); }
    Fact(Pass* pass, std::string_view macro, std::function<bool(const Scene&)> holds) { pass->facts.push_back({macro, nullptr, std::move(holds)}); }
};

/// One pass of a plugin library, linked into the library's own list.
struct Plugin {
    const char* abi;     ///< of the framework it was built against
    const char* type;    ///< name of the struct
    const char* shader;
    const char* doc;
    const char* source;  ///< the .cpp, so that shaders are found beside it
    Pass* (*create)();
    const Plugin* next;
};

/// The passes of the library this is compiled into. Hidden, so that two libraries never share one list.
inline __attribute__((visibility("hidden"))) const Plugin* pluginList = nullptr;

}  // namespace lodestir

/// What the framework looks up in a pass library.
extern "C" LODESTIR_API __attribute__((used)) inline const lodestir::Plugin* lodestirPlugins() {
    return lodestir::pluginList;
}

/// Exports a pass: its struct, the shader that execute() runs by default, and one sentence on what it does.
#define LODESTIR_PASS(T, shaderFile, sentence)                                                                        \
    namespace {                                                                                                       \
    const lodestir::Plugin plugin##T{LODESTIR_ABI, #T,      shaderFile, sentence, __FILE__,                           \
                                     []() -> lodestir::Pass* { return new T; }, lodestir::pluginList};                \
    [[maybe_unused]] const bool listed##T = (lodestir::pluginList = &plugin##T, true);                                \
    }
