// SPDX-License-Identifier: MIT
// What the picture that is made now (B) is compared with: A, which is a picture that was kept, an image from a file, or a graph that runs beside it; and
// by how much they differ.
#pragma once
#include <framework/app/view/live_side.h>
#include <framework/app/view/running_error.h>

namespace lodestir {

class ComparedSides {
public:
    /// A is this picture. `graph`: that made it.
    void keep(const Picture& picture, const std::string& what, SideGraph graph);
    /// A is what this renders.
    void run(std::unique_ptr<LiveSide> live);
    /// A is the image of a file, and whatever else it is later, errors are those against that image. Error where it has another size than frames.
    void read(const Path& file, glm::uvec2 size, Captures& captures);
    /// Of what A is: a live or kept one before an image.
    void release();

    LiveSide* live() { return live_.get(); }
    /// The graph that A is of; null: A is of none.
    const SideGraph* graph() const { return live_ ? &live_->graph() : kept_ ? &kept_->graph : nullptr; }
    SideA a() const;

    /// Measures B, now and then, or `always`. `pick`: the number that histograms are of.
    void measure(const Picture& b, const TexelLayout& layout, std::uint32_t pick, std::uint32_t frames, bool always, Captures& captures);
    void restartErrors() { error_.restart(); }  ///< something was changed: curves begin again
    std::shared_ptr<const ComparedNumbers> numbers() const { return error_.numbers(); }

private:
    void forget();

    struct Kept {
        Picture picture;
        std::string what;
        SideGraph graph;
    };
    struct Image {
        ImageData image;
        Picture picture;
    };

    std::unique_ptr<LiveSide> live_;
    std::optional<Kept> kept_;
    std::optional<Image> image_;
    RunningError error_;
    std::uint64_t measured_ = 0;  ///< number of the picture
    std::string port_;            ///< that it was of
    TexelLayout layout_;
};

}  // namespace lodestir
