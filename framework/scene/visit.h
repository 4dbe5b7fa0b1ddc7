// SPDX-License-Identifier: MIT
// The fields of a scene's structs, for code that treats them all alike. A field that is missing here does not compile.
#pragma once
#include <framework/scene/scene.h>

#include <concepts>
#include <type_traits>

namespace lodestir {

/// visit(v, s) calls v(field) for each field of a struct, in order. The names bind to the fields by place, and have to be as many.
#define LODESTIR_FIELDS(Struct, ...)                                     \
    template <class V, class S>                                          \
        requires std::same_as<std::remove_const_t<S>, Struct>            \
    void visit(V&& v, S& s) {                                            \
        auto& [__VA_ARGS__] = s;                                         \
        [&](auto&... field) { (v(field), ...); }(__VA_ARGS__);           \
    }

LODESTIR_FIELDS(Texture, name, width, height, rgba, srgb, nearest, wrapU, wrapV)
LODESTIR_FIELDS(TextureSlot, texture, uvSet, offset, scale, rotation)
LODESTIR_FIELDS(MaterialLayers, specular, specularColor, sheenColor, sheenRoughness, anisotropy, anisotropyRotation, coat, coatRoughness, coatNormalScale,
                specularMap, specularColorMap, sheenColorMap, sheenRoughnessMap, anisotropyMap, coatMap, coatRoughnessMap, coatNormalMap)
LODESTIR_FIELDS(Material, name, baseColor, metallic, roughness, emission, normalScale, occlusionStrength, transmission, ior, solid, attenuationColor,
                attenuationDistance, alphaMode, alphaCutoff, doubleSided, unlit, layers, baseColorMap, metallicRoughnessMap, normalMap, occlusionMap,
                emissiveMap, transmissionMap)
LODESTIR_FIELDS(MorphTarget, positions, normals, tangents)
LODESTIR_FIELDS(VertexJoints, joints, weights)
LODESTIR_FIELDS(MeshLevel, positions, normals, tangents, uv0, uv1, colors, triangles, materials, error, coverage, targets, joints, flatFaces)
LODESTIR_FIELDS(Skin, nodes, inverseBind)
LODESTIR_FIELDS(Mesh, name, levels, weights, node, skin, shaper)
LODESTIR_FIELDS(Node, name, parent, translation, rotation, scale, matrix)
LODESTIR_FIELDS(Instance, name, mesh, node)
LODESTIR_FIELDS(Light, name, type, color, intensity, range, innerCone, outerCone, node)
LODESTIR_FIELDS(AnimationChannel, node, value, target, interpolation, times, values)
LODESTIR_FIELDS(CameraKey, frame, position, target, up, fovy, height, aperture, focus)
LODESTIR_FIELDS(CameraPath, keys, node)
LODESTIR_FIELDS(Environment, type, width, height, radiance, rotation)
LODESTIR_FIELDS(LodSwitch, frame, instance, level)
LODESTIR_FIELDS(LodPolicy, mode, pixelError, schedule)
LODESTIR_FIELDS(Scene, file, about, meshes, skins, materials, textures, nodes, instances, lights, animation, animationLength, framesPerSecond,
                animationSpeed, camera, environment, cuts, lod, exposure, droppedTriangles, notes)
#undef LODESTIR_FIELDS

}  // namespace lodestir
