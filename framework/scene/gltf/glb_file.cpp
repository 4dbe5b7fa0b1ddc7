// SPDX-License-Identifier: MIT
#include <framework/scene/gltf/glb_file.h>

#include <framework/scene/gltf/uri.h>

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <string_view>

namespace lodestir {
namespace {

using OrderedJson = nlohmann::ordered_json;

constexpr int unsignedShort = 5123, unsignedInt = 5125, floatType = 5126, arrayBuffer = 34962,
              elementBuffer = 34963;  // glTF 2.0, section 5

/// Media type of an image by its first bytes; where they are unknown, by its name.
std::string mediaType(std::span<const std::byte> bytes, const std::string& uri) {
    const std::string_view start(reinterpret_cast<const char*>(bytes.data()), std::min<std::size_t>(bytes.size(), 16));
    if (start.starts_with("\x89PNG")) return "image/png";
    if (start.starts_with("\xff\xd8")) return "image/jpeg";
    if (start.starts_with("RIFF") && start.substr(std::min<std::size_t>(8, start.size())).starts_with("WEBP")) return "image/webp";
    if (start.starts_with("\xabKTX 20")) return "image/ktx2";
    if (start.starts_with("DDS ")) return "image/vnd-ms.dds";
    if (isDataUri(uri) && uri.find("image/") == 5) return uri.substr(5, uri.find_first_of(";,") - 5);
    return "image/" + Path(uri).extension().string().erase(0, 1);
}

void appendWord(std::vector<std::byte>& bytes, std::size_t word) {
    for (int shift = 0; shift < 32; shift += 8) bytes.push_back(std::byte(word >> shift & 255));
}

void appendText(std::vector<std::byte>& bytes, std::string_view text) {
    const auto data = std::as_bytes(std::span(text));
    bytes.insert(bytes.end(), data.begin(), data.end());
}

}  // namespace

GlbFile::GlbFile(const GltfFile& source) : json(source.json.plain()) {
    joinBuffers(source);
    embedImages(source);
}

void GlbFile::joinBuffers(const GltfFile& source) {
    std::vector<std::size_t> starts;
    for (std::size_t i = 0; i < source.buffers.size(); ++i) {
        const std::vector<std::byte>& buffer = source.buffers[i];
        if (buffer.size() < json["buffers"][i].value("byteLength", std::size_t(0)))
            throw source.error(fmt::format("/buffers/{}", i),
                               "the buffer has no data of its own: it belongs to a compression that is not supported",
                               "decompress the model first, for example with: gltf-transform copy");
        binary_.resize((binary_.size() + 7) & ~std::size_t(7));
        starts.push_back(binary_.size());
        binary_.insert(binary_.end(), buffer.begin(), buffer.end());
    }
    if (!json.contains("bufferViews")) return;
    for (std::size_t i = 0; i < json["bufferViews"].size(); ++i) {
        OrderedJson& view = json["bufferViews"][i];
        const auto buffer = view.value("buffer", std::size_t(0));
        if (buffer >= starts.size())
            throw source.error(fmt::format("/bufferViews/{}/buffer", i),
                               fmt::format("there is no buffer {}, the file has {}", buffer, starts.size()));
        if (view.contains("extensions") && view["extensions"].contains("EXT_meshopt_compression"))
            throw source.error(fmt::format("/bufferViews/{}", i), "compressed buffer views cannot be kept",
                               "decompress the model first, for example with: gltf-transform copy");
        view["buffer"] = 0;
        view["byteOffset"] = view.value("byteOffset", std::size_t(0)) + starts[buffer];
    }
}

void GlbFile::embedImages(const GltfFile& source) {
    if (!json.contains("images")) return;
    for (std::size_t i = 0; i < json["images"].size(); ++i) {
        OrderedJson& image = json["images"][i];
        if (!image.contains("uri") || !image["uri"].is_string()) continue;
        const std::string uri = image["uri"];
        std::vector<std::byte> bytes;
        try {
            bytes = readUri(uri, source.path.parent_path());
        } catch (const Error& error) {
            notes.push_back(fmt::format("image {} stays a name: {}", i, error.problems().front().what));
            continue;
        }
        if (!image.contains("name") && !isDataUri(uri)) image["name"] = Path(percentDecode(uri)).stem().string();
        image.erase("uri");
        image["mimeType"] = mediaType(bytes, uri);
        image["bufferView"] = addView(bytes);
    }
}

std::size_t GlbFile::addView(std::span<const std::byte> bytes) {
    binary_.resize((binary_.size() + 3) & ~std::size_t(3));
    json["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", binary_.size()}, {"byteLength", bytes.size()}});
    binary_.insert(binary_.end(), bytes.begin(), bytes.end());
    return json["bufferViews"].size() - 1;
}

std::size_t GlbFile::addIndices(std::span<const std::uint32_t> indices, std::size_t vertices) {
    const bool narrow = vertices < std::numeric_limits<std::uint16_t>::max();  // the largest number means "restart"
    const std::vector<std::uint16_t> shorts(indices.begin(), indices.end());
    const std::size_t view = addView(narrow ? std::as_bytes(std::span(shorts)) : std::as_bytes(indices));
    json["bufferViews"][view]["target"] = elementBuffer;
    json["accessors"].push_back(
        {{"bufferView", view}, {"componentType", narrow ? unsignedShort : unsignedInt}, {"count", indices.size()}, {"type", "SCALAR"}});
    return json["accessors"].size() - 1;
}

std::size_t GlbFile::addColors(std::span<const glm::vec4> colors) {
    const bool narrow = std::ranges::all_of(colors, [](const glm::vec4& c) {
        return glm::all(glm::greaterThanEqual(c, glm::vec4(0))) && glm::all(glm::lessThanEqual(c, glm::vec4(1)));
    });
    std::vector<glm::u16vec4> shorts;
    for (std::size_t i = 0; narrow && i < colors.size(); ++i) shorts.emplace_back(glm::round(65535.0f * colors[i]));
    const std::size_t view = addView(narrow ? std::as_bytes(std::span(shorts)) : std::as_bytes(colors));
    json["bufferViews"][view]["target"] = arrayBuffer;
    json["accessors"].push_back(
        {{"bufferView", view}, {"componentType", narrow ? unsignedShort : floatType}, {"count", colors.size()}, {"type", "VEC4"}});
    if (narrow) json["accessors"].back()["normalized"] = true;
    return json["accessors"].size() - 1;
}

std::size_t GlbFile::addNormals(std::span<const glm::vec3> normals) {
    const std::size_t view = addView(std::as_bytes(normals));
    json["bufferViews"][view]["target"] = arrayBuffer;
    json["accessors"].push_back({{"bufferView", view}, {"componentType", floatType}, {"count", normals.size()}, {"type", "VEC3"}});
    return json["accessors"].size() - 1;
}

void GlbFile::useExtension(const std::string& name) {
    for (const OrderedJson& used : json["extensionsUsed"])
        if (used == name) return;
    json["extensionsUsed"].push_back(name);
}

std::vector<std::byte> GlbFile::bytes() const {
    OrderedJson root = json;
    std::vector<std::byte> binary = binary_;
    root.erase("buffers");
    if (!binary.empty()) root["buffers"] = OrderedJson::array({{{"byteLength", binary.size()}}});
    binary.resize((binary.size() + 3) & ~std::size_t(3));
    std::string text = root.dump(-1, ' ', false, OrderedJson::error_handler_t::replace);
    text.resize((text.size() + 3) & ~std::size_t(3), ' ');
    const std::size_t size = 20 + text.size() + (binary.empty() ? 0 : 8 + binary.size());
    if (size > std::numeric_limits<std::uint32_t>::max()) throw Error("a GLB file cannot be larger than 4 GB");

    std::vector<std::byte> file;
    file.reserve(size);
    appendText(file, "glTF");
    appendWord(file, 2);
    appendWord(file, size);
    appendWord(file, text.size());
    appendText(file, "JSON");
    appendText(file, text);
    if (binary.empty()) return file;
    appendWord(file, binary.size());
    appendText(file, std::string_view("BIN\0", 4));
    file.insert(file.end(), binary.begin(), binary.end());
    return file;
}

}  // namespace lodestir
