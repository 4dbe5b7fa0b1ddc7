// SPDX-License-Identifier: MIT
// Two pictures in one rectangle, A and the one that is made now (B): side by side, in turn, or by their difference.
#pragma once
#include <framework/app/view/picture_painter.h>

#include <string>

namespace lodestir {

class Comparison {
public:
    enum class Side { split, a, b, difference };

    explicit Comparison(const gpu::Device& device) : painter_(device) {}

    /// Takes over what A is. It looks as B does while both are of one kind, and as it looked last when they aren't. `layout`, `look`: of B.
    void follow(const ViewStatus& status, const TexelLayout& layout, const Look& look);
    bool has() const { return a_.picture.texels != nullptr; }  ///< is there an A?
    Side side() const { return side_; }
    float split() const { return split_; }  ///< where A ends and B begins, share of the width
    void turnTo(Side side) { side_ = side; }
    void turn();                            ///< to the next side

    /// The line between the sides; with the names of both, and for the mouse to move, where nothing lies over the picture (`free`). `what`: of B.
    void draw(const Rectangle& area, const std::string& what, bool free);
    /// The picture whose difference is to be shown to `now` of that layout; none where that isn't asked for, or they aren't alike.
    const Picture* subtracted(const Picture& now, const TexelLayout& layout) const;
    /// Records the drawing of A, where it is seen (the rest as PicturePainter has it).
    void prepare(gpu::Commands& commands, const Rectangle& place, const glm::mat3& toImage, bool blueFirst);
    /// B, which `now` has prepared, and A over it.
    void paint(gpu::Commands& commands, VkImage image, const PicturePainter& now) const;

private:
    bool showsA() const { return has() && (side_ == Side::split || side_ == Side::a); }

    PicturePainter painter_;
    SideA a_;
    Look look_;
    Side side_ = Side::split;
    float split_ = 0.5f;
};

}  // namespace lodestir
