// SPDX-License-Identifier: MIT
// A graph in this process, frame by frame, with ports to be read.
#pragma once
#include "../temporary_folder.h"
#include "shared_device.h"
#include "source_folder.h"

#include <framework/app/session.h>
#include <framework/core/json.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cstring>
#include <string>
#include <vector>

namespace lodestir::test {

inline Path sceneFile(const std::string& name) { return sourceFolder / "scenes" / (name + ".json"); }

/// A graph in this process whose ports are read after each frame.
class Frames {
public:
    /// The first port is shown; `libraries`: extra folders of passes.
    Frames(const Path& scene, glm::uvec2 size, const OrderedJson& passes, std::vector<std::string> ports, std::vector<Path> libraries = {}) {
        SessionOptions options;
        options.graph = folder_.path / "graph.json";
        options.renderer.passes = std::move(libraries);
        options.dumps = std::move(ports);
        const OrderedJson graph = {{"format", 1},
                                   {"scene", scene.string()},
                                   {"frame", {{"size", {size.x, size.y}}, {"seed", 1}}},
                                   {"passes", passes},
                                   {"show", options.dumps.at(0)}};
        writeFile(options.graph, graph.dump(2));
        session_ = std::make_unique<Session>(options, SessionParts{.device = sharedDevice()});
    }
    ~Frames() { EXPECT_EQ(session_->device().validationMessages(), std::vector<std::string>{}); }

    const Scene& scene() const { return session_->scene(); }
    void set(const std::string& parameter, const Json& value) { setParameter(session_->graph(), parameter, value); }
    /// Starts again at a frame of the scene, without history.
    void restart(std::uint32_t frame) {
        session_->runner().reset();
        session_->runner().setFrame(frame);
    }
    void restart(std::uint32_t frame, std::uint32_t seed) {
        session_->graph().description.seed = seed;
        restart(frame);
    }
    void run(int frames = 1) {
        for (int i = 0; i < frames; ++i) report_ = session_->runner().run();
    }
    /// Rays that a pass traced in the last frame, by purpose.
    RayCounts rays(const std::string& pass) const {
        for (const PassReport& p : report_.passes)
            if (p.name == pass) return p.rays;
        ADD_FAILURE() << "no pass " << pass;
        return {};
    }
    ImageData image(const std::string& port) { return session_->runner().readImage(findSource(session_->graph(), port)); }
    template <class T> std::vector<T> records(const std::string& port) {
        const std::vector<std::byte> bytes = session_->runner().readBytes(findSource(session_->graph(), port));
        std::vector<T> records(bytes.size() / sizeof(T));
        std::memcpy(records.data(), bytes.data(), bytes.size());
        return records;
    }

private:
    TemporaryFolder folder_;
    std::unique_ptr<Session> session_;
    FrameReport report_;
};

/// Sum over the finite values, which all of them must be.
inline double sumOf(const ImageData& image) {
    double sum = 0;
    for (const float v : image.values) {
        EXPECT_TRUE(std::isfinite(v));
        sum += v;
    }
    return sum;
}

}  // namespace lodestir::test
