// SPDX-License-Identifier: MIT
// Puts a scene into GPU memory and makes the World of each frame: what a World port holds.
#pragma once
#include <framework/gpu/buffer.h>
#include <framework/scene/records.h>
#include <framework/scene/scene.h>
#include <framework/scene/upload/bottom_levels.h>

#include <map>
#include <memory>

namespace lodestir {

/// A World together with what keeps its memory alive.
struct FrameWorld {
    World value;
    std::shared_ptr<const void> keep;
};

/// Uploads what never changes (BVHs, vertices, materials, textures, environment) once; frames share it.
class LODESTIR_API WorldBuilder {
public:
    /// `rayQuery`: the driver's structures over meshes are built, too (World.bottomLevels).
    WorldBuilder(const gpu::Device& device, const Scene& scene, bool rayQuery);
    ~WorldBuilder();
    /// The World at a frame (fractions are fine), for an image of `size` pixels, with the levels of the scene's own policy. Transforms, the
    /// top level, lights and meshes that deform are made anew only when something moved; a World handed out earlier stays as it was. The shutter is open for
    /// so many frames: camera and instances then go straight from where they are to where they are at its end; meshes keep their shape, lights without extent
    /// their place. Error where the driver traces rays, whose structures stand still.
    FrameWorld at(float frame, glm::uvec2 size, float shutter = 0);
    /// Each mesh by itself, as Frame::objects says, in the pose of a World that at() made; nullptr: of frame 0.
    FrameWorld objects(const World* posed);
    SceneRecords records() const;

private:
    struct Shapes;
    struct Fixed;
    struct Moving;
    struct Levels;
    std::shared_ptr<const Shapes> uploadShapes() const;
    std::shared_ptr<const Moving> makeMoving(const Pose& opening, const Pose& closing);
    void moveTo(float frame, float shutter = 0);  ///< moving_ is of that frame and exposure
    World placedWorld() const;  ///< all but levels and camera

    const gpu::Device& device_;
    const Scene& scene_;
    std::shared_ptr<Geometry> geometry_;    ///< as moving_ has it
    std::shared_ptr<const Shapes> shapes_;  ///< null where meshes deform: each pose has its own
    std::shared_ptr<const Fixed> fixed_;
    std::unique_ptr<BottomLevels> bottomLevels_;  ///< null without ray queries
    std::shared_ptr<const Moving> moving_;
    Pose opening_, closing_;  ///< that moving_ was made for
    std::map<VkDeviceAddress, float> frames_;  ///< whose pose lies at World.positions, where meshes deform
    std::shared_ptr<const Levels> levels_;
};

}  // namespace lodestir
