// SPDX-License-Identifier: MIT
// What the renderer tells the scene panel: what there is, how it is shown just now. Plain values, as in view_state.h.
#pragma once
#include <framework/app/view/picking.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace lodestir {

/// What stays the same until a session is built anew.
struct SceneInfo {
    struct Mesh {
        std::vector<std::size_t> triangles;  ///< of each level that can be shown
    };
    struct Instance {
        std::string name;
        std::uint32_t mesh = 0;
    };
    /// A material as its file has it, and which pass changes it.
    struct Material {
        std::string name;
        glm::vec3 baseColor{1}, emission{0};
        float roughness = 1, metallic = 1;
        std::string edit;     ///< name of the material_edit that is for it alone; empty: none
    };
    struct Light {
        std::string name, type, unit;
        float intensity = 0;
        std::string edit;  ///< of the light_edit, likewise
    };
    std::vector<Mesh> meshes;
    std::vector<Instance> instances;
    std::vector<Material> materials;
    std::vector<Light> lights;
    std::string environment;      ///< its type
    std::string environmentEdit;  ///< the light_edit whose factor and turn are the panel's; empty: none
    std::string lod;              ///< the lod_select that levels are forced by; empty: none
    std::string policy;           ///< how levels are chosen where nobody forces them, in words
    std::string levelColors;      ///< port of a level_colors; empty: none
    int lastFrame = 0;            ///< by which all keys, switches and the animation have been seen
};

/// How it is after a frame.
struct SceneState {
    std::vector<std::uint32_t> levels;  ///< that each instance shows
    std::vector<std::uint32_t> forced;  ///< that each is forced to, `none`: as the policy has it
    std::vector<std::uint32_t> pixels;  ///< that each is seen in; empty where the graph has no camera hits
    std::size_t triangles = 0;          ///< of the levels shown, over all instances
    std::size_t finest = 0;             ///< if all showed their finest
    std::size_t bytes = 0;              ///< of geometry and BVHs of the levels shown, each once; 0: not known
    std::optional<Picked> picked;
    std::vector<glm::vec3> corners;  ///< of the box around the picked instance, world space: eight; none where it bends
};

}  // namespace lodestir
