// SPDX-License-Identifier: MIT
// Animations of a glTF model.
#include <framework/scene/gltf/accessor.h>
#include <framework/scene/gltf/animation.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>
#include <utility>

namespace lodestir {
namespace {

std::optional<AnimatedValue> animatedValue(const std::string& path) {
    if (path == "translation") return AnimatedValue::translation;
    if (path == "rotation") return AnimatedValue::rotation;
    if (path == "scale") return AnimatedValue::scale;
    if (path == "weights") return AnimatedValue::weight;
    return std::nullopt;
}

/// Reads the keys of `targets` morph targets, or of one value where that is 0, as a channel each.
std::vector<AnimationChannel> readKeys(const GltfFile& file, const tinygltf::AnimationSampler& sampler, const std::string& pointer,
                                       AnimationChannel channel, std::size_t targets) {
    if (sampler.interpolation == "STEP")
        channel.interpolation = Interpolation::step;
    else if (sampler.interpolation == "CUBICSPLINE")
        channel.interpolation = Interpolation::cubic;
    else if (sampler.interpolation != "LINEAR") {
        throw file.error(pointer + "/interpolation", fmt::format("there is no interpolation \"{}\"", sampler.interpolation),
                         "known: STEP, LINEAR, CUBICSPLINE");
    }
    const Accessor input(file, sampler.input, pointer + "/input"), output(file, sampler.output, pointer + "/output");
    if (input.components() != 1) throw file.error(pointer + "/input", "times must be scalars");
    if (input.count() > 0 && !input.hasData()) return {};  // nothing moves
    channel.times = input.floats();
    if (channel.times.empty()) throw file.error(pointer + "/input", "an animation needs at least one key");
    for (std::size_t i = 0; i < channel.times.size(); ++i) {
        if (!std::isfinite(channel.times[i])) throw file.error(pointer + "/input", fmt::format("the time of key {} is not finite", i));
        // Times below zero are played from zero on; equal ones are a jump.
        if (i > 0 && channel.times[i] < channel.times[i - 1])
            throw file.error(pointer + "/input", fmt::format("times must not fall, key {} does", i));
    }
    const int components = targets > 0 ? 1 : channel.value == AnimatedValue::rotation ? 4 : 3;
    const std::size_t channels = std::max<std::size_t>(targets, 1);
    const std::size_t parts = channel.times.size() * (channel.interpolation == Interpolation::cubic ? 3 : 1);  // keys, or their three parts
    if (output.components() != components)
        throw file.error(pointer + "/output", fmt::format("expected {} components, got {}", components, output.components()));
    if (output.count() != parts * channels)
        throw file.error(pointer + "/output",
                         fmt::format("{} values for {} keys, expected {}", output.count(), channel.times.size(), parts * channels));
    const std::vector<float> values = output.floats();
    std::vector<AnimationChannel> result(channels, channel);
    for (std::size_t i = 0; i < parts * channels; ++i) {
        glm::vec4 value(0);
        for (int c = 0; c < components; ++c) value[c] = values[i * static_cast<std::size_t>(components) + static_cast<std::size_t>(c)];
        if (!std::isfinite(value.x + value.y + value.z + value.w))
            throw file.error(pointer + "/output", fmt::format("value {} is not finite", i));
        result[i % channels].target = static_cast<std::uint32_t>(i % channels);
        result[i % channels].values.push_back(value);
    }
    return result;
}

/// Morph targets of the mesh of a node of the file.
std::size_t targetsOf(const tinygltf::Model& model, int node) {
    const auto mesh = static_cast<std::size_t>(model.nodes[static_cast<std::size_t>(node)].mesh);
    if (mesh >= model.meshes.size() || model.meshes[mesh].primitives.empty()) return 0;
    return model.meshes[mesh].primitives[0].targets.size();
}

using Moved = std::set<std::pair<std::uint32_t, AnimatedValue>>;

/// The channels of animation `a`; Error where its keys cannot be played. A channel that moves nothing here is left out alone.
std::vector<AnimationChannel> readAnimation(GltfImport& import, std::size_t a, Moved& moved) {
    const Scene& scene = import.scene;
    const tinygltf::Animation& animation = import.file.model.animations[a];
    std::vector<AnimationChannel> result;
    for (std::size_t c = 0; c < animation.channels.size(); ++c) {
        const tinygltf::AnimationChannel& source = animation.channels[c];
        const std::optional<AnimatedValue> value = animatedValue(source.target_path);
        if (!value) {
            import.note(fmt::format("animation of \"{}\" is ignored", source.target_path));
            continue;
        }
        if (source.target_node < 0) continue;
        const auto target = static_cast<std::size_t>(source.target_node), sampler = static_cast<std::size_t>(source.sampler);
        if (target >= import.nodes.size() || sampler >= animation.samplers.size()) {
            import.note(fmt::format("/animations/{}/channels/{} names a node or a sampler that is not there; it is ignored", a, c));
            continue;
        }
        const std::uint32_t node = import.nodes[target];
        if (node == none) continue;
        const std::size_t targets = value == AnimatedValue::weight ? targetsOf(import.file.model, source.target_node) : 0;
        if (value == AnimatedValue::weight && targets == 0) {
            import.note(
                fmt::format("node \"{}\" has no morph targets, so the animation of their weights is ignored", scene.nodes[node].name));
            continue;
        }
        if (scene.nodes[node].matrix && value != AnimatedValue::weight) {
            import.note(fmt::format("node \"{}\" has a matrix, so its animation is ignored", scene.nodes[node].name));
            continue;
        }
        if (!moved.insert({node, *value}).second) {
            import.note("animations play together; where two move the same node, the first one counts (a scene file can choose one)");
            continue;
        }
        std::vector<AnimationChannel> channels =
            readKeys(import.file, animation.samplers[sampler], fmt::format("/animations/{}/samplers/{}", a, source.sampler),
                     {.node = node, .value = *value}, targets);
        if (channels.empty()) import.note("animations without data are ignored");
        std::ranges::move(channels, std::back_inserter(result));
    }
    return result;
}

}  // namespace

std::string gltfAnimationName(const GltfFile& file, std::size_t animation) {
    const std::string& name = file.model.animations[animation].name;
    return name.empty() ? fmt::format("animation {}", animation) : name;
}

void loadGltfAnimations(GltfImport& import) {
    Scene& scene = import.scene;
    Moved moved;
    for (std::size_t a = 0; a < import.file.model.animations.size(); ++a) {
        if (import.animation >= 0 && a != static_cast<std::size_t>(import.animation)) continue;
        Moved movedToo = moved;
        try {
            for (AnimationChannel& channel : readAnimation(import, a, movedToo)) {
                scene.animationLength = std::max(scene.animationLength, channel.times.back());
                scene.animation.push_back(std::move(channel));
            }
            moved = std::move(movedToo);
        } catch (const Error& error) {  // half a movement would be none that anybody made
            import.noteLeftOut(fmt::format("animation \"{}\"", gltfAnimationName(import.file, a)), error);
        }
    }
}

}  // namespace lodestir
