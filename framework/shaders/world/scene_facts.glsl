// SPDX-License-Identifier: MIT
// What the materials and levels of the scene ask for. The runner defines as 0 what none of them does, and the compiler leaves it out.
#ifndef SCENE_LAYERS
#define SCENE_LAYERS 1  // MaterialRecord.layers
#endif
#ifndef TEXEL_SURFACES
#define TEXEL_SURFACES 0  // surfaces may be texels of impostors: graphs in which camera hits are (visibility.surfels), and shaders that define it
#endif
#ifndef RAY_LEVELS
#define RAY_LEVELS 0      // instances may dissolve into their next level (world/ray_levels.glsl): graphs in which a pass makes them
#endif
#ifndef MOTION_BLUR
#define MOTION_BLUR 0     // the shutter stays open for a while (world/exposure.glsl)
#endif
#define RAY_NUMBERS (RAY_LEVELS != 0 || MOTION_BLUR != 0)  // paths have numbers by which they choose
#ifndef SCENE_MASKS
#define SCENE_MASKS 1   // MATERIAL_MASK
#endif
#ifndef SCENE_PANES
#define SCENE_PANES 1   // MATERIAL_PANE, where there is a light without extent to shine through it
#endif
#ifndef SCENE_LIGHT_LEVELS
#define SCENE_LIGHT_LEVELS 1  // meshes of several levels are lights (light/light_levels.glsl)
#endif
