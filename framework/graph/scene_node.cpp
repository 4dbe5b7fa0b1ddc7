// SPDX-License-Identifier: MIT
#include <framework/graph/scene_node.h>

#include <framework/graph/plugins.h>

namespace lodestir {
namespace {

struct SceneNode final : Pass {
    Out<World>  world{this, "world", "the scene of this frame: camera, instances, materials, lights"};
    Param<bool> animate{this, "animate", true, "camera keyframes and node animation follow the frames; off: the pose of frame `pose`"};
    Param<int>  pose{this, "pose", 0, {0, 1000000}, "frame whose pose is held while `animate` is off"};

    Param<float> shutter{this, "shutter", 0, {0, 1},
                         "frames for which it is open: while it is, camera and objects go straight from where the frame has them towards where the next one "
                         "does (motion blur); meshes that bend and lights without extent stay. 0.5 is a film camera's 180 degrees"};
    Fact        blurs{this, "MOTION_BLUR", [this](const Scene&) { return shutter > 0; }};

    void execute(Frame& frame) override { frame.provideScene(world, animate ? float(frame.index()) : float(int(pose)), shutter); }
};

}  // namespace

const Plugin& scenePlugin() {
    static const Plugin plugin{frameworkAbi().data(),
                               "SceneNode",
                               "",
                               "Hands out the loaded scene: geometry on the device, and the camera, transforms and lights of each frame.",
                               __FILE__,
                               []() -> Pass* { return new SceneNode; },
                               nullptr};
    return plugin;
}

}  // namespace lodestir
