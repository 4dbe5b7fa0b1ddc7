// SPDX-License-Identifier: MIT
// What flows along the edges of a graph: images, buffers of shared structs, and single shared structs such as World.
#pragma once
#include <framework/core/api.h>
#include <framework/shaders/base/shared.h>

#include <cstdint>
#include <string>
#include <string_view>

namespace lodestir {

class BundlePort;
class Pass;

/// Texel formats. An image is a row-major array of texels in a buffer; GLSL sees float, vec2, vec4 or uint.
enum class Format : std::uint8_t { r16f, rg16f, rgba16f, r32f, rg32f, rgba32f, rgba8, r32ui };

struct FormatFacts {
    std::string_view name;   ///< as written in JSON and docs
    std::string_view glsl;   ///< type of a texel in a shader
    std::uint32_t bytes;     ///< of a texel
    std::uint32_t channels;
};
LODESTIR_API const FormatFacts& factsOf(Format format);

/// Size of an image: a fraction of the frame (rounded up), or that of another port of the same pass.
struct Extent {
    float scale = 1;
    std::string_view like = {};
};

/// Number of elements of a buffer.
struct Count {
    enum class Kind : std::uint8_t { perPixel, fixed, like, reserved } kind = Kind::perPixel;
    std::uint32_t number = 1;        ///< slots of a pixel, or elements
    std::string_view like = {};      ///< another port of the same pass

    static constexpr Count perPixel(std::uint32_t slots = 1) { return {Kind::perPixel, slots, {}}; }
    static constexpr Count fixed(std::uint32_t elements) { return {Kind::fixed, elements, {}}; }
    static constexpr Count likePort(std::string_view port) { return {Kind::like, 1, port}; }
    /// Of scratch: as many as execute() asks for (Frame::reserve), which knows parameters and what handles hold.
    static constexpr Count reserved() { return {Kind::reserved, 1, {}}; }
};

struct Image {};                          ///< tag of an image port
template <class T> struct Buffer {};      ///< tag of a port that is an array of the shared struct T

/// The type of a port. Two ends of an edge fit when kind and name are equal and, for structs, size and the hash of the header's include closure.
struct LODESTIR_API PortType {
    enum class Kind : std::uint8_t { image, buffer, handle } kind = Kind::image;
    std::string_view name = "Image";  ///< "Image", or the shared struct's name
    std::string_view header = {};     ///< of the struct, as included in GLSL; empty for built-in types
    std::size_t size = 0;             ///< of the struct in bytes
    bool chained = false;             ///< see isChained
    std::string text() const;         ///< "Image", "Buffer<Reservoir>", "World"
    bool isSame(const PortType& other) const { return kind == other.kind && name == other.name; }
};
/// Handles that passes hand on one after the other, each changed a little: an input that a graph leaves unwired takes the last that was made, and one
/// whose name ends in "Prev" last frame's. Of any other handle a graph has one, or says which. Specialised where the struct is made known to passes.
template <class R> inline constexpr bool isChained = false;

template <class R> struct PortTypeOf {  // any other shared struct: one value of it, e.g. World
    static constexpr PortType value{PortType::Kind::handle, SharedStruct<R>::name, SharedStruct<R>::header, SharedStruct<R>::size, isChained<R>};
};
template <> struct PortTypeOf<Image> {
    static constexpr PortType value{};
};
template <class T> struct PortTypeOf<Buffer<T>> {
    static constexpr PortType value{PortType::Kind::buffer, SharedStruct<T>::name, SharedStruct<T>::header, SharedStruct<T>::size};
};

/// A port as a pass declares it. `state` is an output that finds its own content of last frame in place; `scratch` lives inside one execute.
struct LODESTIR_API Port {
    enum class Role : std::uint8_t { in, out, state, scratch };
    std::string_view name, doc;  ///< of a bundle's member: "paths.reservoirs"
    PortType type;
    Role role;
    bool optional;   ///< an input that may stay unwired (the shader tests HAS_name), or an output that isn't made where nobody asks for it
    Format format;   ///< of an image that this pass makes
    Extent extent;   ///< of an image that this pass makes
    Count count;     ///< of a buffer that this pass makes
    const BundlePort* bundle = nullptr;  ///< that it is a member of

    bool isInput() const { return role == Role::in; }
    std::string_view wire() const;   ///< the name that a graph wires: its own, or its bundle's
    std::string identifier() const;  ///< its name in shaders: "paths.reservoirs" is pathsReservoirs

protected:
    struct Shape {
        Format format = Format::rgba32f;
        Extent extent = {};
        Count count = {};
    };
    /// Enters the port into the pass's list.
    Port(Pass* pass, std::string_view name, std::string_view doc, PortType type, Role role, Shape shape, bool optional = false);
};

enum class Need : std::uint8_t { required, optional };

/// An input: read-only in the shader, where image `color` is read as color(p), buffer `paths` as paths(i) and struct `world` as world().
template <class R> struct In : Port {
    In(Pass* pass, std::string_view n, std::string_view d, Need need = Need::required)
        : Port(pass, n, d, PortTypeOf<R>::value, Role::in, {}, need == Need::optional) {}
};
/// An output, written as storeColor(p, value) or storePaths(i, value), readable like an input (as madeColor(p) where an input has the same name). A buffer
/// of uint is counted in as well: addCounts(i, 1) adds atomically and gives what was there.
template <class R> struct Out : Port {
    Out(Pass* pass, std::string_view n, std::string_view d) : Port(pass, n, d, PortTypeOf<R>::value, Role::out, {}) {}
    Out(Pass* pass, std::string_view n, std::string_view d, Format f, Extent e = {}) : Port(pass, n, d, PortTypeOf<R>::value, Role::out, {f, e, {}}) {}
    /// With Need::optional no pass may read it that makes it: where no other does and nobody looks at it, it has no memory and storing does nothing.
    Out(Pass* pass, std::string_view n, std::string_view d, Format f, Need need)
        : Port(pass, n, d, PortTypeOf<R>::value, Role::out, {f, {}, {}}, need == Need::optional) {}
    Out(Pass* pass, std::string_view n, std::string_view d, Count c) : Port(pass, n, d, PortTypeOf<R>::value, Role::out, {.count = c}) {}
};
/// Kept from frame to frame: an output that starts each frame with last frame's content; zero after start, resize, cut and reset.
template <class R> struct State : Port {
    State(Pass* pass, std::string_view n, std::string_view d, Format f, Extent e = {}) : Port(pass, n, d, PortTypeOf<R>::value, Role::state, {f, e, {}}) {}
    State(Pass* pass, std::string_view n, std::string_view d, Count c) : Port(pass, n, d, PortTypeOf<R>::value, Role::state, {.count = c}) {}
};
/// Memory of one execute: undefined before, gone after.
template <class R> struct Scratch : Port {
    Scratch(Pass* pass, std::string_view n, std::string_view d, Format f, Extent e = {}) : Port(pass, n, d, PortTypeOf<R>::value, Role::scratch, {f, e, {}}) {}
    Scratch(Pass* pass, std::string_view n, std::string_view d, Count c) : Port(pass, n, d, PortTypeOf<R>::value, Role::scratch, {.count = c}) {}
};

}  // namespace lodestir
