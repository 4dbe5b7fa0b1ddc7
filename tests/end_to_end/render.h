// SPDX-License-Identifier: MIT
// Frames of a graph file, rendered in this process: many small runs that would each start a program, and make its kernels ready, again.
#pragma once
#include "shared_device.h"

#include <framework/app/session.h>

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

namespace lodestir::test {

/// The images `show` of the first `count` frames; `rays`: the ray body, empty: the fastest.
inline std::vector<ImageData> render(const Path& graph, const std::string& show, int count, GraphOptions changes = {}, const std::string& rays = {}) {
    changes.show = show;
    Session session({.graph = graph, .changes = std::move(changes), .renderer = {.passes = {}, .device = {}, .rays = rays}, .dumps = {}},
                    {.device = sharedDevice()});
    std::vector<ImageData> images;
    for (int frame = 0; frame < count; ++frame) {
        session.runner().run();
        images.push_back(session.runner().readImage(session.graph().show));
    }
    EXPECT_EQ(sharedDevice()->validationMessages(), std::vector<std::string>{});
    return images;
}

}  // namespace lodestir::test
