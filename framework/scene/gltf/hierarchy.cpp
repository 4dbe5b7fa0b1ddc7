// SPDX-License-Identifier: MIT
// The node hierarchy of a glTF file, checked to be a forest.
#include <framework/scene/gltf/hierarchy.h>

#include <fmt/format.h>

#include <algorithm>

namespace lodestir {
namespace {

void checkNode(const GltfFile& file, int node, const std::string& user) {
    const std::size_t count = file.model.nodes.size();
    if (node < 0 || static_cast<std::size_t>(node) >= count)
        throw file.error(user, fmt::format("there is no node {}, the file has {}", node, count));
}

/// Parent of each node, -1 for roots; every node has at most one and no node is its own ancestor.
std::vector<int> checkedParents(const GltfFile& file) {
    const auto& nodes = file.model.nodes;
    std::vector<int> parents(nodes.size(), -1);
    for (std::size_t n = 0; n < nodes.size(); ++n) {
        for (std::size_t c = 0; c < nodes[n].children.size(); ++c) {
            const int child = nodes[n].children[c];
            const std::string user = fmt::format("/nodes/{}/children/{}", n, c);
            checkNode(file, child, user);
            int& parent = parents[static_cast<std::size_t>(child)];
            if (parent >= 0)
                throw file.error(user, fmt::format("node {} is a child of node {} too", child, parent), "a node has one parent at most");
            parent = static_cast<int>(n);
        }
    }
    std::vector<char> safe(nodes.size(), 0);  // 1: its ancestors end at a root
    std::vector<std::size_t> chain;
    for (std::size_t n = 0; n < nodes.size(); ++n) {
        chain.clear();
        int at = static_cast<int>(n);
        while (at >= 0 && !safe[static_cast<std::size_t>(at)]) {
            chain.push_back(static_cast<std::size_t>(at));
            if (chain.size() > nodes.size())
                throw file.error(fmt::format("/nodes/{}/children", at), fmt::format("node {} is among its own descendants", at));
            at = parents[static_cast<std::size_t>(at)];
        }
        for (std::size_t link : chain) safe[link] = 1;
    }
    return parents;
}

std::vector<int> sceneRoots(const GltfFile& file, const std::vector<int>& parents) {
    const auto& model = file.model;
    std::vector<int> roots;
    if (model.scenes.empty()) {
        for (std::size_t n = 0; n < parents.size(); ++n) {
            if (parents[n] < 0) roots.push_back(static_cast<int>(n));
        }
        return roots;
    }
    const int scene = std::max(model.defaultScene, 0);
    if (static_cast<std::size_t>(scene) >= model.scenes.size())
        throw file.error("/scene", fmt::format("there is no scene {}, the file has {}", scene, model.scenes.size()));
    const std::vector<int>& listed = model.scenes[static_cast<std::size_t>(scene)].nodes;
    std::vector<char> isListed(parents.size(), 0), isRoot(parents.size(), 0);
    for (std::size_t i = 0; i < listed.size(); ++i) {
        checkNode(file, listed[i], fmt::format("/scenes/{}/nodes/{}", scene, i));
        isListed[static_cast<std::size_t>(listed[i])] = 1;
    }
    // Some writers list every node; a node that the scene reaches through its parent is not placed a second time.
    for (int node : listed) {
        int ancestor = parents[static_cast<std::size_t>(node)];
        while (ancestor >= 0 && !isListed[static_cast<std::size_t>(ancestor)]) ancestor = parents[static_cast<std::size_t>(ancestor)];
        if (ancestor >= 0 || isRoot[static_cast<std::size_t>(node)]) continue;
        isRoot[static_cast<std::size_t>(node)] = 1;
        roots.push_back(node);
    }
    return roots;
}

}  // namespace

std::vector<int> coarserLevels(const GltfFile& file, int node) {
    const tinygltf::Value* lod = findExtension(file.model.nodes[static_cast<std::size_t>(node)].extensions, "MSFT_lod");
    std::vector<int> levels;
    if (!lod || !lod->Has("ids")) return levels;
    const tinygltf::Value& ids = lod->Get("ids");
    for (int i = 0; i < static_cast<int>(ids.ArrayLen()); ++i) {
        const std::string user = fmt::format("/nodes/{}/extensions/MSFT_lod/ids/{}", node, i);
        if (!ids.Get(i).IsInt()) throw file.error(user, "expected the index of a node");
        const int level = ids.Get(i).GetNumberAsInt();
        checkNode(file, level, user);
        if (level == node) throw file.error(user, "a node cannot be a coarser level of itself");
        levels.push_back(level);
    }
    return levels;
}

std::vector<GltfVisit> visitGltfScene(const GltfFile& file) {
    const std::vector<int> parents = checkedParents(file);
    std::vector<char> isLevel(file.model.nodes.size(), 0);
    for (std::size_t n = 0; n < isLevel.size(); ++n) {
        for (int level : coarserLevels(file, static_cast<int>(n))) isLevel[static_cast<std::size_t>(level)] = 1;
    }
    std::vector<GltfVisit> order, stack;
    const std::vector<int> roots = sceneRoots(file, parents);
    for (auto root = roots.rbegin(); root != roots.rend(); ++root) stack.push_back({*root, -1});
    while (!stack.empty()) {
        const GltfVisit visit = stack.back();
        stack.pop_back();
        if (isLevel[static_cast<std::size_t>(visit.node)]) continue;
        order.push_back(visit);
        const std::vector<int>& children = file.model.nodes[static_cast<std::size_t>(visit.node)].children;
        for (auto child = children.rbegin(); child != children.rend(); ++child) stack.push_back({*child, visit.node});
    }
    return order;
}

}  // namespace lodestir
