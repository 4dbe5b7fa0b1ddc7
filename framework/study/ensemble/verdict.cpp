// SPDX-License-Identifier: MIT
#include <framework/core/tasks.h>
#include <framework/study/ensemble/verdict.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <span>

namespace lodestir {
namespace {

/// Standard deviation, as a share of the mean, that rounding is taken for: 16-bit storage is off by up to 4.9e-4 and sums in 32 bits by
/// less.
constexpr double rounding = 1e-4;
constexpr std::array<double, 2> faultSizes{0.01, 0.03};
constexpr std::size_t faultTrials = 200, nullTrials = 500;
constexpr double enough = 0.95;
constexpr std::array<const char*, 3> colours{"red", "green", "blue"};

/// Everything a test looks at, one column after the other: energies, then blocks by colours; each a value a run.
struct Columns {
    std::size_t runs = 0;
    std::vector<double> values;

    explicit Columns(const BlockMeans& means) : runs(means.runs()), values(runs * (4 + 3 * means.grid.count())) {
        const std::size_t width = 3 * means.grid.count();
        for (std::size_t run = 0; run < runs; ++run) {
            const Energy energy = energyOf(means, run);
            for (std::size_t i = 0; i < 4; ++i) values[i * runs + run] = energy[i];
            for (std::size_t i = 0; i < width; ++i) values[(4 + i) * runs + run] = means.values[run * width + i];
        }
    }
    std::size_t count() const { return values.size() / runs; }
    std::span<const double> of(std::size_t column) const { return std::span(values).subspan(column * runs, runs); }
};

std::vector<Moments> columnMoments(const Columns& columns) {
    std::vector<Moments> all(columns.count());
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = momentsOf(columns.of(i));
    return all;
}

EnsembleTests testMoments(const std::vector<Moments>& x, const std::vector<Moments>& y) {
    EnsembleTests tests;
    tests.blocks.resize(x.size() - 4);
    double energyP = 2, blockP = 2;
    for (std::size_t i = 0; i < x.size(); ++i) {
        const MeanTest test = compareMeans(x[i], y[i], rounding * std::abs(y[i].mean));
        if (i < 4) {
            tests.energy[i] = test;
            if (test.p < energyP) energyP = test.p, tests.worstEnergy = int(i);
        } else {
            tests.blocks[i - 4] = test;
            if (test.p < blockP) blockP = test.p, tests.worstBlock = int(i - 4);
        }
    }
    tests.energyP = std::min(1.0, 4 * energyP);
    tests.blockP = std::min(1.0, double(tests.blocks.size()) * blockP);
    return tests;
}

/// Draws ensembles from the measured ones, shifted so that nothing is wrong with them but what is put in.
class Bootstrap {
public:
    Bootstrap(const BlockMeans& runs, const BlockMeans& reference, double level)
        : grid_(runs.grid), runs_(runs), reference_(reference), truth_(columnMoments(reference_)), level_(level) {
        const std::vector<Moments> measured = columnMoments(runs_);
        for (std::size_t i = 0; i < measured.size(); ++i)
            for (std::size_t run = 0; run < runs_.runs; ++run) runs_.values[i * runs_.runs + run] += truth_[i].mean - measured[i].mean;
        for (std::size_t block = 0; block < grid_.count(); ++block)
            if (luminance(block) >= truth_[0].mean) bright_.push_back(block);
    }

    /// Share of trials that the tests reject.
    double rejected(const PlantedFault& fault, std::size_t trials) const {
        std::vector<unsigned char> hits(trials);
        parallelFor(trials, 8, [&](std::size_t begin, std::size_t end) {
            for (std::size_t trial = begin; trial < end; ++trial) hits[trial] = rejects(fault, trial);
        });
        return double(std::ranges::count(hits, 1)) / double(trials);
    }

private:
    double luminance(std::size_t block) const {
        const Moments* m = &truth_[4 + 3 * block];
        return 0.2126 * m[0].mean + 0.7152 * m[1].mean + 0.0722 * m[2].mean;
    }

    static std::vector<std::size_t> draw(std::size_t count, std::mt19937_64& random) {
        std::vector<std::size_t> chosen(count);
        for (std::size_t& index : chosen) index = random() % count;
        return chosen;
    }
    static Moments drawn(std::span<const double> values, const std::vector<std::size_t>& chosen, double scale) {
        std::vector<double> sample(chosen.size());
        for (std::size_t i = 0; i < chosen.size(); ++i) sample[i] = scale * values[chosen[i]];
        return momentsOf(sample);
    }

    bool rejects(const PlantedFault& fault, std::size_t trial) const {
        std::mt19937_64 random(trial * 2654435761u + 1);
        const std::vector<std::size_t> runs = draw(runs_.runs, random), batches = draw(reference_.runs, random);
        const double size = trial % 2 == 0 ? fault.size : -fault.size;
        const std::size_t block = fault.block && !bright_.empty() ? bright_[trial / 2 % bright_.size()] : 0;
        std::vector<Moments> x(runs_.count()), y(runs_.count());
        for (std::size_t i = 0; i < x.size(); ++i) {
            double scale = 1;
            if (!fault.block)
                scale = 1 + size;
            else if (i >= 4 && (i - 4) / 3 == block)
                scale = 1 + size * truth_[0].mean / (grid_.share(block) * luminance(block));
            x[i] = drawn(runs_.of(i), runs, scale);
            y[i] = drawn(reference_.of(i), batches, 1);
        }
        const EnsembleTests tests = testMoments(x, y);
        return tests.blockP < level_ || (!fault.block && tests.energyP < level_);
    }

    BlockGrid grid_;
    Columns runs_, reference_;
    std::vector<Moments> truth_;
    std::vector<std::size_t> bright_;
    double level_;
};

Energy meanEnergy(const BlockMeans& means) {
    Energy mean{};
    for (std::size_t run = 0; run < means.runs(); ++run) {
        const Energy energy = energyOf(means, run);
        for (std::size_t i = 0; i < mean.size(); ++i) mean[i] += energy[i] / double(means.runs());
    }
    return mean;
}

std::string signedPercent(double share) { return fmt::format("{:+.2g} %", 100 * share); }

void conclude(EnsembleResult& result, const VerdictOptions& options) {
    const EnsembleTests& tests = result.tests;
    std::vector<std::string> faults;
    if (tests.energyP < options.level) {
        const auto i = std::size_t(tests.worstEnergy);
        faults.push_back(fmt::format("energy: {} {} ({:+.1f} sigmas)", energyNames[i],
                                     signedPercent(tests.energy[i].difference / result.referenceEnergy[i]), tests.energy[i].t));
    }
    if (tests.blockP < options.level) {
        const int block = tests.worstBlock / 3, columns = result.grid.columns();
        const auto worst = std::size_t(tests.worstBlock);
        faults.push_back(fmt::format("block ({}, {}): {} {} ({:+.1f} sigmas)", block % columns, block / columns, colours[worst % 3],
                                     signedPercent(tests.blocks[worst].difference / result.referenceBlocks[worst]), tests.blocks[worst].t));
    }
    if (!faults.empty()) {
        result.verdict = Verdict::biased;
        result.reason = faults.front() + (faults.size() > 1 ? "; " + faults.back() : "");
        return;
    }
    result.verdict = Verdict::inconclusive;
    if (!(result.halfWidth <= options.halfWidth)) {
        const double more = result.halfWidth / options.halfWidth;
        result.reason =
            fmt::format("the energy is known to +-{:.2g} % only, {:.2g} % are asked for: about {:.2g} times as many runs would do",
                        100 * result.halfWidth, 100 * options.halfWidth, more * more);
        return;
    }
    for (const PlantedFault& fault : result.faults)
        if (fault.needed && fault.caught < enough) {
            result.reason = fmt::format("a planted fault of {:g} % {} is caught {:.0f} times in 100 only", 100 * fault.size,
                                        fault.block ? "in one block" : "everywhere", 100 * fault.caught);
            return;
        }
    result.verdict = Verdict::unbiased;
    result.reason = fmt::format("energy {} +- {:.2g} %, largest of {} blocks and colours {:+.1f} sigmas",
                                signedPercent(tests.energy[0].difference / result.referenceEnergy[0]), 100 * result.halfWidth,
                                tests.blocks.size(), tests.blocks[std::size_t(tests.worstBlock)].t);
}

}  // namespace

std::string_view nameOf(Verdict verdict) {
    return verdict == Verdict::unbiased ? "unbiased" : verdict == Verdict::biased ? "biased" : "inconclusive";
}

EnsembleTests testEnsemble(const BlockMeans& runs, const BlockMeans& reference) {
    return testMoments(columnMoments(Columns(runs)), columnMoments(Columns(reference)));
}

EnsembleResult judgeEnsemble(const BlockMeans& runs, const BlockMeans& reference, const VerdictOptions& options) {
    EnsembleResult result{.runs = int(runs.runs()), .batches = int(reference.runs()), .grid = runs.grid};
    result.energy = meanEnergy(runs);
    result.referenceEnergy = meanEnergy(reference);
    result.tests = testEnsemble(runs, reference);
    result.referenceBlocks.resize(result.tests.blocks.size());
    for (std::size_t i = 0; i < reference.values.size(); ++i)
        result.referenceBlocks[i % result.referenceBlocks.size()] += reference.values[i] / double(reference.runs());
    result.halfWidth = result.tests.energy[0].halfWidth() / std::abs(result.referenceEnergy[0]);
    const auto broken = std::ranges::count_if(runs.values, [](double value) { return !std::isfinite(value); });
    if (broken > 0) {
        result.verdict = Verdict::biased;
        result.reason = fmt::format("{} block means are not finite", broken);
        return result;
    }
    const Bootstrap bootstrap(runs, reference, options.level);
    result.falseAlarms = bootstrap.rejected({}, nullTrials);
    for (const bool block : {false, true})
        for (const double size : faultSizes) {
            PlantedFault fault{.size = size, .block = block, .needed = size > 2.999 * options.halfWidth};
            fault.caught = bootstrap.rejected(fault, faultTrials);
            result.faults.push_back(fault);
        }
    conclude(result, options);
    return result;
}

}  // namespace lodestir
