// SPDX-License-Identifier: MIT
// Containers of glTF 2.0 (JSON text, GLB), checked before anything else is believed.
#include <framework/core/file_kind.h>
#include <framework/scene/gltf/file.h>
#include <framework/scene/gltf/meshopt.h>
#include <framework/scene/gltf/structure.h>
#include <framework/scene/gltf/uri.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cstring>

namespace lodestir {
namespace {

constexpr std::array supportedExtensions{
    "KHR_lights_punctual",
    "KHR_materials_emissive_strength",
    "KHR_materials_ior",
    "KHR_materials_transmission",
    "KHR_materials_volume",
    "KHR_materials_specular",
    "KHR_materials_sheen",
    "KHR_materials_anisotropy",
    "KHR_materials_clearcoat",
    "KHR_materials_unlit",
    "KHR_materials_variants",
    "KHR_mesh_quantization",
    "KHR_materials_pbrSpecularGlossiness",
    "MSFT_lod",
    "KHR_texture_transform",
    "EXT_mesh_gpu_instancing",
    "EXT_meshopt_compression",
    "KHR_meshopt_compression",
};

constexpr std::uint32_t glbMagic = 0x46546c67, jsonChunk = 0x4e4f534a, binChunk = 0x004e4942;  // "glTF", "JSON", "BIN\0"

/// The two chunks of a GLB that count (glTF 2.0, section 4.4); the others are skipped.
struct Container {
    std::string_view text;
    std::span<const std::byte> binary;
    bool hasBinary = false;
};

std::uint32_t word(std::span<const std::byte> bytes, std::size_t offset) {
    std::uint32_t value;
    std::memcpy(&value, bytes.data() + offset, sizeof value);
    return value;
}

Container openBinary(std::span<const std::byte> bytes, const std::string& file) {
    const auto fail = [&](const std::string& what) { throw Error(Where{file}, "not a valid GLB file: " + what); };
    if (bytes.size() < 12) fail(fmt::format("{} bytes are less than its 12-byte header", bytes.size()));
    if (const std::uint32_t version = word(bytes, 4); version != 2) {
        throw Error(Where{file}, fmt::format("GLB version {} is not supported", version), "convert the model to glTF 2.0");
    }
    const std::size_t length = word(bytes, 8);
    if (length > bytes.size()) fail(fmt::format("its header says {} bytes, the file has {}; it is cut short", length, bytes.size()));

    Container container;
    for (std::size_t offset = 12, index = 0; offset < length; ++index) {
        if (length - offset < 8) fail(fmt::format("a chunk header is cut short at byte {}", offset));
        const std::size_t size = word(bytes, offset);
        const std::uint32_t type = word(bytes, offset + 4);
        if (size > length - offset - 8)
            fail(fmt::format("the chunk at byte {} says {} bytes, {} are left", offset, size, length - offset - 8));
        const auto data = bytes.subspan(offset + 8, size);
        if (index == 0 && type != jsonChunk) fail("its first chunk is not JSON");
        if (index == 0) container.text = {reinterpret_cast<const char*>(data.data()), data.size()};
        if (index == 1 && type == binChunk) {
            container.binary = data;
            container.hasBinary = true;
        }
        offset += 8 + size;
    }
    if (container.text.empty()) fail("it has no JSON chunk");
    while (!container.text.empty() && container.text.back() == '\0') container.text.remove_suffix(1);  // some writers pad with zeros
    return container;
}

/// The value that a JSON pointer names, or the deepest one on its way. Names with "~" or "/" do not occur in our pointers.
const Json& follow(const Json& root, std::string_view pointer) {
    const Json* value = &root;
    while (!pointer.empty()) {
        pointer.remove_prefix(1);
        const std::string_view token = pointer.substr(0, pointer.find('/'));
        pointer.remove_prefix(token.size());
        const Json* next = value->find(token);
        if (value->isArray()) {
            std::size_t index = 0;
            const auto [end, failed] = std::from_chars(token.data(), token.data() + token.size(), index);
            if (failed == std::errc{} && end == token.data() + token.size() && index < value->items().size()) next = &value->items()[index];
        }
        if (!next) break;
        value = next;
    }
    return *value;
}

/// "2.1" -> {2, 1}; {0, 0} when it is no version.
std::pair<int, int> parseVersion(const std::string& text) {
    int major = 0, minor = 0;
    const char* end = text.data() + text.size();
    const auto first = std::from_chars(text.data(), end, major);
    if (first.ec != std::errc{} || first.ptr == end || *first.ptr != '.') return {0, 0};
    const auto second = std::from_chars(first.ptr + 1, end, minor);
    return second.ec == std::errc{} && second.ptr == end ? std::pair{major, minor} : std::pair{0, 0};
}

void checkVersion(const GltfFile& file) {
    const Json* asset = file.json.find("asset");
    const Json* version = asset ? asset->find("version") : nullptr;
    if (!version || !version->isString())
        throw file.error("/asset/version", "no glTF version is given", "a glTF 2.0 file says \"asset\": {\"version\": \"2.0\"}");
    if (parseVersion(version->asString()).first != 2) {
        throw file.error("/asset/version", fmt::format("glTF version \"{}\" is not supported", version->asString()),
                         "convert the model to glTF 2.0");
    }
    const Json* least = asset->find("minVersion");
    if (least && least->isString() && parseVersion(least->asString()) > std::pair{2, 0}) {
        throw file.error("/asset/minVersion", fmt::format("it needs glTF {} or later, 2.0 is supported", least->asString()));
    }
}

void checkExtensions(const GltfFile& file, Problems& problems) {
    const Json* required = file.json.find("extensionsRequired");
    if (!required || !required->isArray()) return;
    for (const Json& name : required->items()) {
        if (!name.isString() || isSupportedGltfExtension(name.asString())) continue;
        const std::string& extension = name.asString();
        std::string hint;
        if (extension.find("draco") != std::string::npos)
            hint = "decompress the model first, for example with: gltf-transform copy";
        else if (extension.find("gaussian_splatting") != std::string::npos)
            hint = "Gaussian splats are not meshes; only meshes are shown";
        else if (extension == "KHR_texture_basisu" || extension == "EXT_texture_webp" || extension == "EXT_texture_avif")
            hint = "convert its textures to PNG or JPEG";
        problems.add(file.binary ? Where{file.path.string()} : name.where(),
                     fmt::format("the model needs extension {}, which is not supported", extension), hint);
    }
}

/// Every view of the buffer is compressed, or it has none: what it would hold is not needed, and may be missing.
bool isFallback(const GltfFile& file, std::size_t buffer) {
    const Json* views = file.json.find("bufferViews");
    if (!views || !views->isArray()) return false;
    bool compressed = false;
    for (const Json& view : views->items()) {
        const Json *from = view.find("buffer"), *extensions = view.find("extensions");
        if (!from || !from->isNumber() || from->asNumber() != static_cast<double>(buffer)) continue;
        if (!extensions || !(extensions->find("EXT_meshopt_compression") || extensions->find("KHR_meshopt_compression"))) return false;
        compressed = true;
    }
    return compressed || file.json.find("buffers")->items()[buffer].find("extensions");
}

/// `whole`: the file's bytes, which become those of a buffer inside it.
void readBuffers(GltfFile& file, const Container& container, std::vector<std::byte> whole, Problems& problems) {
    const Json* buffers = file.json.find("buffers");
    if (!buffers) return;
    if (!buffers->isArray()) throw file.error("/buffers", fmt::format("expected an array, got {}", buffers->kindName()));
    for (std::size_t i = 0; i < buffers->items().size(); ++i) {
        const std::string pointer = fmt::format("/buffers/{}", i);
        std::vector<std::byte>& bytes = file.buffers.emplace_back();
        try {
            const Json& buffer = buffers->items()[i];
            const Json *uri = buffer.find("uri"), *length = buffer.find("byteLength");
            const std::int64_t expected = length ? length->asInt("byteLength") : -1;
            if (expected < 0) throw file.error(pointer + "/byteLength", "a buffer needs its length in bytes");
            const bool fallback = isFallback(file, i);
            if (uri && !fallback) {
                try {
                    bytes = readUri(uri->asString("uri"), file.path.parent_path());
                } catch (const Error& error) {
                    throw file.error(pointer + "/uri", error);
                }
            } else if (i == 0 && container.hasBinary) {
                const std::ptrdiff_t start = container.binary.data() - whole.data();
                bytes = std::move(whole);
                bytes.resize(static_cast<std::size_t>(start) + container.binary.size());
                bytes.erase(bytes.begin(), bytes.begin() + start);
            } else {
                continue;  // it has no data, which is wrong only where somebody wants to read it
            }
            if (bytes.size() < static_cast<std::size_t>(expected) && !fallback) {
                throw file.error(pointer, fmt::format("the buffer says {} bytes, its data has {}", expected, bytes.size()),
                                 "is the file cut short?");
            }
            bytes.resize(std::min(bytes.size(), static_cast<std::size_t>(expected)));
        } catch (const Error& error) {
            problems.add(error);
        }
    }
}

}  // namespace

bool isSupportedGltfExtension(std::string_view name) {
    return std::find(supportedExtensions.begin(), supportedExtensions.end(), name) != supportedExtensions.end();
}

Error GltfFile::error(const std::string& pointer, const std::string& what, const std::string& hint) const {
    Where where = binary ? Where{} : follow(json, pointer).where();
    where.file = path.string();
    return Error(where, pointer + ": " + what, hint);
}

Error GltfFile::error(const std::string& pointer, const Error& cause) const {
    const Problem& problem = cause.problems().front();
    return error(pointer, problem.where.file.empty() ? problem.what : problem.where.file + ": " + problem.what, problem.hint);
}

GltfFile readGltfFile(const Path& path) {
    static_assert(std::endian::native == std::endian::little, "glTF buffers are little-endian and read in place");
    std::vector<std::byte> bytes = readBytes(path);
    GltfFile file;
    file.path = path;
    file.binary = bytes.size() >= 4 && word(bytes, 0) == glbMagic;
    Container container{.text = {reinterpret_cast<const char*>(bytes.data()), bytes.size()}};
    if (file.binary) container = openBinary(bytes, path.string());

    file.json = Json::parse(container.text, path.string());
    expectKind(file.json, FileKind::model);
    if (!file.json.isObject()) throw Error(Where{path.string()}, fmt::format("a glTF file is a JSON object, this is {}", file.json.kindName()));
    checkVersion(file);
    Problems problems;
    checkExtensions(file, problems);
    problems.raise();  // alone: what else is wrong may come from the extension
    readBuffers(file, container, std::move(bytes), problems);
    problems.raise();
    parseGltfStructure(file);
    decodeMeshopt(file, problems);
    problems.raise();
    return file;
}

}  // namespace lodestir
