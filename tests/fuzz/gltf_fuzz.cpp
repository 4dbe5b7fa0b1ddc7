// SPDX-License-Identifier: MIT
// Any bytes as a glTF model, text or GLB: read, posed, and its hierarchies built. A GLB's chunks are mutated apart and framed anew.
#include "input_file.h"
#include "json_mutator.h"

#include <framework/scene/gltf/gltf.h>
#include <framework/scene/bvh/mesh_bvh.h>

namespace {

constexpr std::size_t headerSize = 20, chunkHeaderSize = 8;

std::uint32_t word(const std::uint8_t* bytes) {
    std::uint32_t value;
    std::memcpy(&value, bytes, sizeof value);
    return value;
}

void append(std::string& bytes, std::size_t word) {
    const auto value = static_cast<std::uint32_t>(word);
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

std::string mutatedBytes(std::string bytes, std::size_t maxSize) {
    const std::size_t before = std::min(bytes.size(), maxSize);
    bytes.resize(maxSize);
    bytes.resize(LLVMFuzzerMutate(reinterpret_cast<std::uint8_t*>(bytes.data()), before, maxSize));
    return bytes;
}

std::string framed(std::string text, std::string binary) {
    text.resize((text.size() + 3) & ~std::size_t(3), ' ');
    std::string bytes = "glTF";
    append(bytes, 2);
    append(bytes, headerSize + text.size() + (binary.empty() ? 0 : chunkHeaderSize + binary.size()));
    append(bytes, text.size());
    bytes += "JSON" + text;
    if (!binary.empty()) {
        append(bytes, binary.size());
        bytes += std::string("BIN\0", 4) + binary;
    }
    return bytes;
}

}  // namespace

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t maxSize, unsigned seed) {
    const std::string whole(reinterpret_cast<const char*>(data), size);
    std::string result;
    const std::size_t textSize = size > headerSize ? word(data + 12) : 0;
    lodestir::fuzz::JsonMutator mutator(seed);
    if (!whole.starts_with("glTF")) {
        result = mutator.mutated(whole, maxSize);
    } else if (textSize == 0 || textSize > size - headerSize || seed % 8 == 0) {
        result = mutatedBytes(whole, maxSize);
    } else {
        std::string text = whole.substr(headerSize, textSize);
        std::string binary = whole.substr(std::min(size, headerSize + textSize + chunkHeaderSize));
        const std::size_t frame = headerSize + chunkHeaderSize + 4, rest = maxSize > frame + size ? maxSize - frame - size : 0;
        if (seed % 4 == 1 && !binary.empty())
            binary = mutatedBytes(binary, binary.size() + rest);
        else
            text = mutator.mutated(text, text.size() + rest);
        result = framed(text, binary);
        if (result.size() > maxSize) result = mutatedBytes(whole, maxSize);
    }
    std::memcpy(data, result.data(), result.size());
    return result.size();
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const lodestir::fuzz::Folder folder;
    const bool isBinary = size >= 4 && std::memcmp(data, "glTF", 4) == 0;
    const lodestir::Path file = folder.write(isBinary ? "input.glb" : "input.gltf", {data, size});
    lodestir::fuzz::expectErrorOrResult([&] {
        lodestir::Scene scene;
        lodestir::loadGltf(file, scene, lodestir::none);
        scene.nodeMatrices(17);
        if (!scene.camera.keys.empty()) scene.cameraAt(3);
        scene.bounds();
        constexpr std::size_t largest = 5000;  // triangles: building is not what is in question
        for (const lodestir::Mesh& mesh : scene.meshes) {
            for (std::size_t level = 0; level < mesh.levels.size(); ++level) {
                if (mesh.levels[level].triangles.size() < largest) lodestir::meshBvh(scene, mesh, level);
            }
        }
    });
    return 0;
}
