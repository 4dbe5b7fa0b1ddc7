// SPDX-License-Identifier: MIT
#include <framework/graph/scene_node.h>

#include <framework/graph/plugins.h>

namespace lodestir {
namespace {

struct SceneNode final : Pass {
    Out<World>  world{this, "world", "the scene of this frame: camera, instances, materials, lights"};
    Param<bool> animate{this, "animate", true, "camera keyframes and node animation follow the frames; off: the pose of frame `pose`"};
    Param<int>  pose{this, "pose", 0, {0, 1000000}, "frame whose pose is held while `animate` is off"};

    void execute(Frame& frame) override { frame.provideScene(world, animate ? float(frame.index()) : float(int(pose))); }
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
