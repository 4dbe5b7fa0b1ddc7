// SPDX-License-Identifier: MIT
// A graph of reservoir passes in this process: frames, energies of images, and what passes/restir/shift_check measured of its shifts.
#pragma once
#include "frames.h"
#include "statistics.h"

#include <passes/restir/reservoir.h>
#include <passes/restir/shift_check/shift_check.h>

#include <glm/gtc/packing.hpp>

#include <array>
#include <map>

namespace lodestir::test {

/// Nodes that graphs of reservoirs are put together from.
inline OrderedJson hitsNode() {
    return {{"type", "visibility"}, {"in", {{"worldPrev", "scene@prev"}}}, {"set", {{"film", "centre"}, {"lens", false}}}};
}
inline OrderedJson initialNode(OrderedJson set) { return {{"type", "initial_sampling"}, {"set", std::move(set)}}; }
/// Inputs of a pass that takes the paths of `paths`.
inline OrderedJson pathsOf(const std::string& paths) { return {{"hits", "hits"}, {"paths", paths}}; }
/// The same with the paths that `history` left last frame.
inline OrderedJson pathsOf(const std::string& paths, const std::string& history) {
    OrderedJson in = pathsOf(paths);
    in.update(OrderedJson{{"hitsPrev", "hits@prev"}, {"motion", "hits.motion"}, {"worldPrev", "scene@prev"}, {"history", history + "@prev"}});
    return in;
}
inline OrderedJson node(const std::string& type, OrderedJson in, OrderedJson set = OrderedJson::object()) {
    return {{"type", type}, {"in", std::move(in)}, {"set", std::move(set)}};
}
inline OrderedJson shadeNode(const std::string& paths) { return node("shade_reservoirs", {{"paths", paths}}); }

/// c of a reservoir, frames.
inline float confidenceOf(const Reservoir& r) { return glm::unpackHalf1x16(std::uint16_t(r.shape >> SHAPE_CONFIDENCE)); }

struct ShiftSessionSetup {
    Path scene;
    glm::uvec2 size{64, 64};
    OrderedJson passes;
    std::vector<std::string> images;   ///< nodes with an output `color` whose energy is read after each frame
    std::vector<std::string> checks;   ///< nodes of shift_check, likewise
    std::vector<Path> libraries = {};  ///< extra folders of passes
};

class ShiftSession {
public:
    explicit ShiftSession(const ShiftSessionSetup& setup) : frames_(setup.scene, setup.size, setup.passes, portsOf(setup), setup.libraries) {}

    void set(const std::string& parameter, const Json& value) { frames_.set(parameter, value); }
    /// Starts again at a frame of the scene, without history.
    void restart(std::uint32_t frame) { frames_.restart(frame); }
    void frame() { frames_.run(); }
    /// Mean luminance of a node's `color`.
    double energy(const std::string& name) {
        const ImageData image = frames_.image(name + ".color");
        double sum = 0;
        for (int y = 0; y < image.height; ++y)
            for (int x = 0; x < image.width; ++x)
                sum += 0.2126 * image.at(x, y, 0) + 0.7152 * image.at(x, y, 1) + 0.0722 * image.at(x, y, 2);
        return sum / (double(image.width) * image.height);
    }
    /// Two records a pixel: see shift_check.
    std::vector<ShiftCheck> checks(const std::string& name) { return frames_.records<ShiftCheck>(name + ".checks"); }

private:
    static std::vector<std::string> portsOf(const ShiftSessionSetup& setup) {
        std::vector<std::string> ports;
        for (const std::string& name : setup.images) ports.push_back(name + ".color");
        for (const std::string& name : setup.checks) ports.push_back(name + ".checks");
        return ports;
    }

    Frames frames_;
};

/// Ways to end a path, which differ in their Jacobians: RC_* of restir/reservoir.glsl.
enum class PathEnd { replayed, surface, toLight, emitter, environment, light };
inline constexpr std::array<const char*, 6> pathEndNames{"replayed", "surface", "surface to light", "emitter", "environment", "light"};

inline PathEnd pathEnd(std::uint32_t shape) {
    const std::uint32_t d = shape >> SHAPE_LENGTH & 31u, k = shape >> SHAPE_RECONNECTION & 31u;
    const bool nee = (shape >> SHAPE_NEE & 1u) != 0;
    if (k == 0) return PathEnd::replayed;
    if (k == d)
        return nee ? PathEnd::light : (shape >> SHAPE_LIGHT & 3u) == PATH_LIGHT_ENVIRONMENT ? PathEnd::environment : PathEnd::emitter;
    return nee && k + 1 == d ? PathEnd::toLight : PathEnd::surface;
}

/// a / b of sums over independent frames, with the half-width of its 95 % interval.
struct Ratio {
    double value = 1, halfWidth = 0;

    /// Is 1 within three and a third standard errors (one in a thousand)?
    bool isOne() const { return std::abs(value - 1) <= halfWidth * 3.3 / 1.96 + 1e-6; }
};
inline Ratio ratioOf(const std::vector<double>& a, const std::vector<double>& b) {
    std::vector<double> differences;
    for (std::size_t i = 0; i < a.size(); ++i) differences.push_back(a[i] - b[i]);
    const Mean difference = meanOf(differences);
    const double base = meanOf(b).value;
    return base > 0 ? Ratio{1 + difference.value / base, 1.96 * std::sqrt(difference.variance) / base} : Ratio{};
}
/// The same of frames that have nothing to do with each other.
inline Ratio ratioOfIndependent(const std::vector<double>& a, const std::vector<double>& b) {
    const Mean x = meanOf(a), y = meanOf(b);
    return {x.value / y.value, 1.96 * std::sqrt(x.variance / (y.value * y.value) + y.variance * x.value * x.value / std::pow(y.value, 4))};
}

/// What shift_check recorded over some frames.
struct RoundTrips {
    /// Energy that both ends see, a frame: by the partner's paths, shifted here, and by the own ones that may be shifted there.
    struct Energy {
        std::vector<double> hither, thither;

        Ratio ratio() const { return ratioOf(hither, thither); }
        double mean() const { return meanOf(thither).value; }
    };
    struct Kind {
        std::size_t returned = 0;
        std::vector<float> errorsF;  ///< of those that returned
        Energy all;
        Energy stretched;  ///< of paths whose directions spread on the way here: a Jacobian can't be wrong by one factor there and its inverse back
        Energy unequal;    ///< of paths worth more than four times as much at one end as at the other: they count for little in `all`

        std::array<const Energy*, 3> energies() const { return {&all, &stretched, &unequal}; }
    };
    static constexpr std::array<const char*, 3> energyNames{"", ", stretched", ", unequal"};
    std::size_t tried = 0, there = 0, lost = 0, different = 0;
    float worstJacobian = 0;
    std::vector<float> errorsMis;
    std::array<Kind, 6> kinds;
    Kind all;

    void add(const std::vector<ShiftCheck>& records) {
        for (Kind& kind : kinds) begin(kind);
        begin(all);
        for (std::size_t i = 0; i < records.size(); ++i) {
            const ShiftCheck& r = records[i];
            if (!(r.outcome & CHECK_TRIED)) continue;
            ++tried;
            errorsMis.push_back(finite(r.errorMis));
            if (!(r.outcome & CHECK_THERE)) continue;
            ++there;
            Kind& kind = kinds[std::size_t(pathEnd(r.shape))];
            // e s / (e + s) is no more than either, so its mean has no heavy tail; and both ends give the same function of the path.
            const double e = finite(r.energy), s = finite(r.energyShifted), shared = e + s > 0 ? e * s / (e + s) : 0;
            const bool hither = i % 2 == 0, stretched = hither ? r.stretch > 1 : r.stretch < 1, unequal = std::max(e, s) > 4 * std::min(e, s);
            for (Kind* k : {&kind, &all}) {
                (hither ? k->all.hither : k->all.thither).back() += shared;
                if (stretched) (hither ? k->stretched.hither : k->stretched.thither).back() += shared;
                if (unequal) (hither ? k->unequal.hither : k->unequal.thither).back() += shared;
            }
            if (!(r.outcome & CHECK_BACK)) ++lost;
            if (!(r.outcome & CHECK_BACK)) continue;
            if (!(r.outcome & CHECK_SAME)) ++different;
            worstJacobian = std::max(worstJacobian, finite(r.errorJacobian));
            for (Kind* k : {&kind, &all}) {
                ++k->returned;
                k->errorsF.push_back(finite(r.errorF));
            }
        }
    }
    const Kind& of(PathEnd end) const { return kinds[std::size_t(end)]; }

    static double shareAbove(const std::vector<float>& errors, float limit) {
        return errors.empty() ? 0 : double(std::ranges::count_if(errors, [&](float e) { return e > limit; })) / double(errors.size());
    }
    static float largest(const std::vector<float>& errors) { return errors.empty() ? 0 : *std::ranges::max_element(errors); }

private:
    static void begin(Kind& kind) {
        for (Energy* energy : {&kind.all, &kind.stretched, &kind.unequal}) {
            energy->hither.push_back(0);
            energy->thither.push_back(0);
        }
    }
    static float finite(float x) { return std::isfinite(x) ? x : 1e30f; }
};

}  // namespace lodestir::test
