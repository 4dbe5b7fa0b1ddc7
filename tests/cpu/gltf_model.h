// SPDX-License-Identifier: MIT
// Writes small glTF models for tests: accessors are appended to one buffer that becomes a data URI.
#pragma once
#include <framework/core/files.h>

#include <nlohmann/json.hpp>

#include <cstring>
#include <string>
#include <vector>

namespace lodestir {

class GltfModel {
public:
    nlohmann::json json{{"asset", {{"version", "2.0"}}}};

    /// Appends values as a tightly packed accessor and returns its index.
    template <class T>
    int accessor(const std::vector<T>& values, int componentType, const char* type, std::size_t components, bool normalized = false) {
        while (bytes_.size() % 4) bytes_.push_back(0);
        const std::size_t offset = bytes_.size(), size = values.size() * sizeof(T);
        bytes_.resize(offset + size);
        if (size) std::memcpy(bytes_.data() + offset, values.data(), size);
        json["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", offset}, {"byteLength", size}});
        json["accessors"].push_back({{"bufferView", json["bufferViews"].size() - 1},
                                     {"componentType", componentType},
                                     {"count", values.size() / components},
                                     {"type", type}});
        if (normalized) json["accessors"].back()["normalized"] = true;
        return static_cast<int>(json["accessors"].size()) - 1;
    }
    int positions(const std::vector<float>& xyz) { return accessor(xyz, 5126, "VEC3", 3); }
    int indices(const std::vector<std::uint16_t>& values) { return accessor(values, 5123, "SCALAR", 1); }

    /// A mesh of one primitive and a node for it in the scene; returns the node.
    int addMesh(const nlohmann::json& primitive) {
        json["meshes"].push_back({{"primitives", nlohmann::json::array({primitive})}});
        json["nodes"].push_back({{"mesh", json["meshes"].size() - 1}});
        json["scenes"][0]["nodes"].push_back(json["nodes"].size() - 1);
        return static_cast<int>(json["nodes"].size()) - 1;
    }

    /// A right triangle (0,0,0), (1,0,0), (0,1,0) as mesh and node.
    int addTriangle() { return addMesh({{"attributes", {{"POSITION", positions({0, 0, 0, 1, 0, 0, 0, 1, 0})}}}}); }

    /// Writes the .gltf file into a folder of the tests and returns its path.
    Path write(const Path& path) {
        if (!bytes_.empty())
            json["buffers"] = {{{"byteLength", bytes_.size()}, {"uri", "data:application/octet-stream;base64," + base64()}}};
        writeFile(path, json.dump(1));
        return path;
    }

    std::vector<unsigned char>& bytes() { return bytes_; }

private:
    std::string base64() const {
        constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
        std::string text;
        for (std::size_t i = 0; i < bytes_.size(); i += 3) {
            unsigned word = 0;
            const std::size_t left = std::min<std::size_t>(3, bytes_.size() - i);
            for (std::size_t k = 0; k < left; ++k) word |= unsigned(bytes_[i + k]) << (16 - 8 * k);
            for (std::size_t k = 0; k < 4; ++k) text += k <= left ? digits[word >> (18 - 6 * k) & 63] : '=';
        }
        return text;
    }

    std::vector<unsigned char> bytes_;
};

}  // namespace lodestir
