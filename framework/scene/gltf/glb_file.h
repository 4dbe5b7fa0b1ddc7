// SPDX-License-Identifier: MIT
// A glTF file on its way to becoming one binary file: buffers joined, images embedded, data added.
#pragma once
#include <framework/scene/gltf/file.h>

#include <nlohmann/json.hpp>

#include <span>

namespace lodestir {

/// The JSON may be changed freely; the bytes only grow.
class LODESTIR_API GlbFile {
public:
    /// Takes over all of a file; an image that cannot be read stays a name, with a note. Error when a buffer view needs a decoder.
    explicit GlbFile(const GltfFile& source);

    nlohmann::ordered_json json;
    std::vector<std::string> notes;

    /// Appends triangle indices as an accessor and returns its number; 16 bits where `vertices` allows them.
    std::size_t addIndices(std::span<const std::uint32_t> indices, std::size_t vertices);
    /// Appends colours as a VEC4 accessor and returns its number: of 16 bits where all are within [0, 1], else floats.
    std::size_t addColors(std::span<const glm::vec4> colors);
    /// Appends normals as a VEC3 accessor of floats and returns its number.
    std::size_t addNormals(std::span<const glm::vec3> normals);
    void useExtension(const std::string& name);

    /// The container (glTF 2.0, section 4.4). Error when it would be larger than 4 GB.
    std::vector<std::byte> bytes() const;

private:
    std::size_t addView(std::span<const std::byte> bytes);
    void joinBuffers(const GltfFile& source);
    void embedImages(const GltfFile& source);

    std::vector<std::byte> binary_;
};

}  // namespace lodestir
