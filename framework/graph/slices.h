// SPDX-License-Identifier: MIT
// Cuts the dispatches of a frame into pieces that take about equally long: long work would keep a device from answering anyone else.
#pragma once
#include <framework/core/api.h>

#include <cstdint>
#include <map>
#include <utility>

namespace lodestir {

class LODESTIR_API Slices {
public:
    /// Names a dispatch from frame to frame: its node, and which of the node's dispatches it is.
    using Key = std::pair<int, int>;

    /// `budget`: milliseconds of a piece; 0 or less: nothing is ever cut.
    explicit Slices(double budget) : budget_(budget) {}

    /// How many of the `rows` that are left of a dispatch go into the current piece: a multiple of `grain`, or all. 0: close() the piece first.
    /// What wasn't measured yet starts with a few rows.
    std::uint32_t take(Key key, std::uint32_t rows, std::uint32_t grain);
    bool full() const { return budget_ > 0 && used_ >= budget_; }  ///< nothing more should go into this piece
    void close() { used_ = 0; }                                    ///< the next piece begins
    void measured(Key key, std::uint32_t rows, double milliseconds);
    bool cuts() const { return budget_ > 0; }

private:
    double budget_, used_ = 0;             ///< used: what this piece should take, going by what was measured
    std::map<Key, double> cost_;           ///< milliseconds a row
};

}  // namespace lodestir
