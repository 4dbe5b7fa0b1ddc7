// SPDX-License-Identifier: MIT
// What accumulates, and when it starts again: behind passes that hand out a World of their own in each frame, too.
#include "sheets.h"
#include "shift_session.h"

namespace lodestir::test {
namespace {

class Accumulation : public Sheets {
protected:
    /// For each of some frames, over how many frames the mean goes: the last so many frames have it.
    std::vector<int> countsOf(const OrderedJson& worldMaker, int frames, const std::function<void(Frames&, int)>& before = {}, OrderedJson camera = {}) {
        const bool switches = worldMaker["set"].contains("mode") && worldMaker["set"]["mode"] == "schedule";
        OrderedJson extra = OrderedJson::object();
        if (!camera.is_null()) extra["camera"] = std::move(camera);
        writeLevels(folder.path, "bowls", {{.cells = 20, .place = bowl}, {.cells = 4, .place = bowl}});
        const Path scene = write("bowls", {"bowls"}, switches ? switchAt(3) : OrderedJson::array(), extra);
        OrderedJson passes = {{"maker", worldMaker},
                              {"trace", node("path_tracer", OrderedJson::object())},
                              {"accumulate", node("accumulate", {{"color", "trace"}})}};
        Frames session(scene, {32, 18}, passes, {"trace.color", "accumulate.mean"});
        std::vector<std::vector<float>> seen;
        std::vector<int> counts;
        for (int frame = 0; frame < frames; ++frame) {
            if (before) before(session, frame);
            session.run();
            seen.push_back(session.image("trace.color").values);
            const std::vector<float> mean = session.image("accumulate.mean").values;
            int found = 0;
            for (int count = 1; count <= frame + 1; ++count) {
                double apart = 0;
                for (std::size_t i = 0; i < mean.size(); ++i) {
                    if (i % 4 == 3) continue;
                    double sum = 0;
                    for (int k = 0; k < count; ++k) sum += double(seen[seen.size() - 1 - std::size_t(k)][i]);
                    apart = std::max(apart, std::abs(sum / count - double(mean[i])));
                }
                if (apart < 1e-5) found = count;
            }
            counts.push_back(found);
        }
        return counts;
    }
    static OrderedJson lod(const char* mode) { return node("lod_select", OrderedJson::object(), {{"mode", mode}}); }
};

// If this fails, a picture whose levels a pass chooses never comes to rest.
TEST_F(Accumulation, GoesOnWhereAPassMakesTheWorld) {
    const std::vector<int> all{1, 2, 3, 4, 5};
    for (const char* mode : {"finest", "screen_error", "depth", "stochastic"}) EXPECT_EQ(countsOf(lod(mode), 5), all) << mode;
    EXPECT_EQ(countsOf(node("material_edit", OrderedJson::object(), {{"red", 0.5}}), 5), all);
    EXPECT_EQ(countsOf(node("orbit", OrderedJson::object(), {{"directions", 0}, {"distance", 1.2}}), 5), all);
}

// If this fails, the mean goes over frames that showed something else.
TEST_F(Accumulation, StartsAgainWhereSomethingChanges) {
    EXPECT_EQ(countsOf(lod("schedule"), 6), (std::vector{1, 2, 3, 1, 2, 3})) << "a level, by the schedule";
    EXPECT_EQ(countsOf(node("orbit", OrderedJson::object(), {{"directions", 0}, {"turn", 5}}), 3), (std::vector{1, 1, 1})) << "the camera, by a pass";
    const auto edit = [](Frames& frames, int frame) {
        if (frame == 2) frames.set("maker.red", Json(0.25));
    };
    EXPECT_EQ(countsOf(node("material_edit", OrderedJson::object(), {{"red", 0.5}}), 5, edit), (std::vector{1, 2, 1, 2, 3})) << "a parameter";
    const auto key = [](int frame, double away) { return OrderedJson{{"frame", frame}, {"position", {0.4, 2.6, away}}}; };
    const OrderedJson camera = {
        {"position", {0.4, 2.6, 2.6}}, {"target", {0, 0.1, 0}}, {"keyframes", OrderedJson::array({key(1, 2.6), key(3, 2.8)})}};
    EXPECT_EQ(countsOf(lod("stochastic"), 6, {}, camera), (std::vector{1, 2, 1, 1, 2, 3})) << "the camera, by the scene";
}

}  // namespace
}  // namespace lodestir::test
