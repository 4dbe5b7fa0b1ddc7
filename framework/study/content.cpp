// SPDX-License-Identifier: MIT
#include <framework/core/is_file.h>
#include <framework/gpu/include_closure.h>
#include <framework/study/content.h>

#include <algorithm>
#include <span>

namespace lodestir {
namespace {

/// Values without padding, one after the other.
template <class... T> void addAll(Hash& hash, const T&... values) { (hash.addValue(values), ...); }

template <class T> void addList(Hash& hash, const std::vector<T>& list) {
    hash.addValue(list.size());
    hash.add(std::as_bytes(std::span(list)));
}

void add(Hash& hash, const TextureSlot& slot) { addAll(hash, slot.texture, slot.uvSet, slot.offset, slot.scale, slot.rotation); }

void add(Hash& hash, const Material& m) {
    addAll(hash, m.baseColor, m.metallic, m.roughness, m.emission, m.normalScale, m.occlusionStrength, m.transmission, m.ior, m.solid,
           m.attenuationColor, m.attenuationDistance, m.alphaMode, m.alphaCutoff, m.doubleSided);
    for (const TextureSlot* slot :
         {&m.baseColorMap, &m.metallicRoughnessMap, &m.normalMap, &m.occlusionMap, &m.emissiveMap, &m.transmissionMap})
        add(hash, *slot);
}

void add(Hash& hash, const MeshLevel& level) {
    addList(hash, level.positions);
    addList(hash, level.normals);
    addList(hash, level.tangents);
    addList(hash, level.uv0);
    addList(hash, level.uv1);
    addList(hash, level.colors);
    addList(hash, level.triangles);
    addList(hash, level.materials);
    addList(hash, level.joints);
    for (const MorphTarget& target : level.targets) {
        addList(hash, target.positions);
        addList(hash, target.normals);
        addList(hash, target.tangents);
    }
    addAll(hash, level.error);
}

void add(Hash& hash, const Texture& t) {
    addAll(hash, t.width, t.height, t.srgb, t.nearest, t.wrapU, t.wrapV);
    addList(hash, t.rgba);
}

void add(Hash& hash, const Node& node) {
    addAll(hash, node.parent, node.translation, node.rotation, node.scale, node.matrix.has_value(), node.matrix.value_or(glm::mat4(1)));
}

void add(Hash& hash, const AnimationChannel& channel) {
    addAll(hash, channel.node, channel.value, channel.target, channel.interpolation);
    addList(hash, channel.times);
    addList(hash, channel.values);
}

void add(Hash& hash, const CameraKey& key) { addAll(hash, key.frame, key.position, key.target, key.up, key.fovy, key.height, key.aperture, key.focus); }

/// All shaders of the folder, because a pass may dispatch more than the one it is declared with, and the pass's own code.
void addSources(Hash& hash, const Plugin& plugin) {
    if (!plugin.source || !plugin.shader || std::string_view(plugin.shader).empty()) return;
    const Path folder = shaderOf(plugin, plugin.shader).parent_path();
    std::vector<Path> shaders;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
        if (entry.path().extension() == ".comp") shaders.push_back(entry.path());
    std::ranges::sort(shaders);
    for (const Path& shader : shaders) gpu::IncludeClosure(shader, includeFolders(plugin), {}).addTo(hash);
    if (isFile(plugin.source)) hash.add(readText(plugin.source));
}

}  // namespace

Hash contentOf(const Graph& graph) {
    Hash hash;
    Json text = graph.resolved();
    text.remove("scene");
    text.remove("about");
    hash.add(text.dump(-1));
    for (const GraphNode& node : graph.nodes) {
        if (node.plugin) addSources(hash, *node.plugin);
        for (const Parameter* parameter : node.pass->parameters)
            if (const auto* file = std::get_if<std::string>(&parameter->value); parameter->isFile && !file->empty()) hash.add(readBytes(*file));
    }
    return hash;
}

Hash contentOf(const Scene& scene) {
    Hash hash;
    for (const Mesh& mesh : scene.meshes) {
        addAll(hash, mesh.levels.size(), mesh.node, mesh.skin);
        addList(hash, mesh.weights);
        for (const MeshLevel& level : mesh.levels) add(hash, level);
    }
    for (const Skin& skin : scene.skins) {
        addList(hash, skin.nodes);
        addList(hash, skin.inverseBind);
    }
    for (const Material& material : scene.materials) add(hash, material);
    for (const Texture& texture : scene.textures) add(hash, texture);
    for (const Node& node : scene.nodes) add(hash, node);
    for (const Instance& instance : scene.instances) addAll(hash, instance.mesh, instance.node);
    for (const Light& l : scene.lights) addAll(hash, l.type, l.color, l.intensity, l.range, l.innerCone, l.outerCone, l.node);
    for (const AnimationChannel& channel : scene.animation) add(hash, channel);
    addAll(hash, scene.animationLength, scene.framesPerSecond, scene.animationSpeed);
    for (const CameraKey& key : scene.camera.keys) add(hash, key);
    addAll(hash, scene.camera.node, scene.environment.type, scene.environment.width, scene.environment.height, scene.environment.rotation);
    addList(hash, scene.environment.radiance);
    addList(hash, scene.cuts);
    addAll(hash, scene.lod.mode, scene.lod.pixelError);
    for (const LodSwitch& change : scene.lod.schedule) addAll(hash, change.frame, change.instance, change.level);
    addAll(hash, scene.exposure);
    return hash;
}

}  // namespace lodestir
