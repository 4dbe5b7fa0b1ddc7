// SPDX-License-Identifier: MIT
#include <framework/graph/ray_purposes.h>
#include <framework/study/frame_cost.h>

namespace lodestir {

std::vector<PassCost> costsOf(const FrameReport& report) {
    std::vector<PassCost> costs;
    for (const PassReport& pass : report.passes) {
        if (pass.setup) continue;
        PassCost cost{.name = pass.name, .milliseconds = pass.milliseconds};
        for (std::size_t i = 0; i < rayPurposes.size(); ++i)
            if (i != RAYS_STEPS) cost.rays[std::string(rayPurposes[i])] = pass.rays[i];
        costs.push_back(std::move(cost));
    }
    return costs;
}

double raysOf(const FrameReport& report) {
    double rays = 0;
    for (const PassCost& pass : costsOf(report))
        for (const auto& [purpose, count] : pass.rays) rays += double(count);
    return rays;
}

double stepsOf(const FrameReport& report) {
    double steps = 0;
    for (const PassReport& pass : report.passes)
        if (!pass.setup) steps += double(pass.rays[RAYS_STEPS]);
    return steps;
}

}  // namespace lodestir
