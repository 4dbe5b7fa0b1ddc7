// SPDX-License-Identifier: MIT
// A picture that was kept (A) beside the one that is made now (B): another port, variant, graph or parameter, seen side by side, in turn, or by their
// difference.
#pragma once
#include <framework/app/view/picture_painter.h>

#include <optional>
#include <string>

namespace lodestir {

class Comparison {
public:
    enum class Side { split, kept, now, difference };

    explicit Comparison(const gpu::Device& device) : painter_(device) {}

    bool keeps() const { return kept_.has_value(); }
    /// A is this picture, as it looks now, from here on. `what`: its port and what was chosen otherwise.
    void keep(const Picture& picture, const TexelLayout& layout, const Look& look, const std::string& what);
    void release() { kept_.reset(); }
    Side side() const { return side_; }
    float split() const { return split_; }  ///< where A ends and B begins, share of the width
    void turnTo(Side side) { side_ = side; }
    void turn();                            ///< to the next side

    /// The line between the sides, which the mouse moves, and the names of both. `what`: of B.
    void draw(const Rectangle& area, const std::string& what);
    /// The picture whose difference is to be shown to `now` of that layout; none where that isn't asked for, or they aren't alike.
    const Picture* subtracted(const Picture& now, const TexelLayout& layout) const;
    /// Records the drawing of A, where it is seen (the rest as PicturePainter has it).
    void prepare(gpu::Commands& commands, const Rectangle& place, const glm::mat3& toImage, bool blueFirst);
    /// B, which `now` has prepared, and A over it.
    void paint(gpu::Commands& commands, VkImage image, const PicturePainter& now) const;

private:
    struct Kept {
        Picture picture;
        TexelLayout layout;
        Look look;
        std::string what;
    };

    bool showsKept() const { return kept_ && (side_ == Side::split || side_ == Side::kept); }

    PicturePainter painter_;
    std::optional<Kept> kept_;
    Side side_ = Side::split;
    float split_ = 0.5f;
};

}  // namespace lodestir
