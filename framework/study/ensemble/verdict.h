// SPDX-License-Identifier: MIT
// The judgement over an ensemble: do independent runs of a technique have the mean that the reference has, and would a fault have been
// seen?
#pragma once
#include <framework/study/ensemble/block_means.h>
#include <framework/study/ensemble/moments.h>

#include <string>
#include <string_view>
#include <vector>

namespace lodestir {

enum class Verdict { unbiased, biased, inconclusive };
std::string_view nameOf(Verdict verdict);

struct VerdictOptions {
    double halfWidth = 0.003;  ///< widest 95 % half-width of the energy, as a share of it, that anything is concluded from
    double level = 1e-3;       ///< probability of each of the two tests (energy, blocks) to blame correct code, over all it looks at
};

/// Both tests over one pair of ensembles.
struct EnsembleTests {
    std::array<MeanTest, 4> energy;       ///< of energyNames
    std::vector<MeanTest> blocks;         ///< block by block, in each the three colours
    int worstEnergy = 0, worstBlock = 0;  ///< of the smallest p
    double energyP = 1, blockP = 1;       ///< of those, times their number (Bonferroni), at most 1
};

/// A fault put on purpose into the measured runs, and how often the tests see it.
struct PlantedFault {
    double size = 0;      ///< share of the energy that appears or is lost
    bool block = false;   ///< in one block only, one that holds at least the mean energy; the tests of blocks alone have to see it
    double caught = 0;    ///< share of the trials
    bool needed = false;  ///< the verdict depends on it
};

struct EnsembleResult {
    int runs = 0, batches = 0;  ///< of the technique, of the reference
    BlockGrid grid;
    Energy energy{}, referenceEnergy{};
    std::vector<double> referenceBlocks;  ///< means, parallel to EnsembleTests::blocks
    EnsembleTests tests;
    double halfWidth = 0;  ///< of the 95 % interval of the luminance's difference, as a share of the reference's; its noise included
    std::vector<PlantedFault> faults;
    double falseAlarms = 0;  ///< share of trials without a fault that are blamed all the same; expected: 2 x level
    Verdict verdict = Verdict::inconclusive;
    std::string reason;  ///< one line: what is wrong and where, or what it rests on
};

/// `runs` against `reference`, each by itself an ensemble of independent runs, at least two.
EnsembleTests testEnsemble(const BlockMeans& runs, const BlockMeans& reference);

/// The tests, their power and the verdict. Power is found by bootstrap: trials draw as many runs as there are, with replacement, from runs
/// that were shifted to the reference's mean, and put a fault into them. The same runs always give the same result. biased: a test rejects.
/// inconclusive: none does, but the interval is too wide or faults that such an interval promises to show (of three half-widths and more)
/// are caught less than 95 times in 100. Else unbiased.
EnsembleResult judgeEnsemble(const BlockMeans& runs, const BlockMeans& reference, const VerdictOptions& options);

}  // namespace lodestir
