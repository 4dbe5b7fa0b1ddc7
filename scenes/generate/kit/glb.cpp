// SPDX-License-Identifier: MIT
// Binary glTF writer: see glb.h. Section numbers are those of the glTF 2.0 specification.
#include "glb.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <set>
#include <stdexcept>

namespace lodestir::generate {

namespace {

using nlohmann::json;

// Values of section 5 (accessor.componentType, bufferView.target, sampler filters and wrap).
constexpr int unsignedShort = 5123, unsignedInt = 5125, floating = 5126;
constexpr int arrayBuffer = 34962, elementBuffer = 34963;
constexpr int linear = 9729, linearMipmapLinear = 9987, repeat = 10497;

/// Six decimals are finer than a float of this size; they keep the file short and the same everywhere.
double tidy(float value) { return std::round(double(value) * 1e6) / 1e6; }

template <int N> json array(const glm::vec<N, float>& v) {
    json list = json::array();
    for (int i = 0; i < N; ++i) list.push_back(tidy(v[i]));
    return list;
}

void appendWord(std::vector<uint8_t>& bytes, uint32_t word) {
    for (int shift = 0; shift < 32; shift += 8) bytes.push_back(uint8_t(word >> shift));
}

}  // namespace

glm::quat turnTo(const glm::vec3& direction) {
    const glm::vec3 up = std::abs(glm::normalize(direction).y) > 0.99f ? glm::vec3(0, 0, 1) : glm::vec3(0, 1, 0);
    return glm::quatLookAt(glm::normalize(direction), up);
}

glm::quat turnY(float degrees) { return glm::angleAxis(glm::radians(degrees), glm::vec3(0, 1, 0)); }

void Model::add(int material, const Mesh& mesh) {
    const auto part = std::find_if(parts.begin(), parts.end(), [&](const auto& p) { return p.first == material; });
    append(part == parts.end() ? parts.emplace_back(material, Mesh{}).second : part->second, mesh);
}

struct Glb::Tables {
    json pictures = json::array(), textures = json::array(), materials = json::array();
    json views = json::array(), accessors = json::array();
    json meshes = json::array(), nodes = json::array(), lights = json::array();
    json channels = json::array(), samplers = json::array();  ///< of the one animation
    std::vector<json> geometries;                             ///< primitives without their material
    json skins = json::array();
    std::set<int> owned;                                      ///< nodes that are no roots: levels, and what hangs on others

    int addPlacedNode(json node, const Placement& placement) {
        if (placement.translation != glm::vec3(0)) node["translation"] = array(placement.translation);
        const glm::quat& q = placement.rotation;
        if (q != glm::quat(1, 0, 0, 0)) node["rotation"] = array(glm::vec4(q.x, q.y, q.z, q.w));
        if (placement.scale != glm::vec3(1)) node["scale"] = array(placement.scale);
        nodes.push_back(node);
        return int(nodes.size()) - 1;
    }
};

Glb::Glb() : tables(std::make_unique<Tables>()) {}
Glb::Glb(Glb&&) noexcept = default;
Glb::~Glb() = default;

void Glb::use(const std::string& extension) {
    if (std::find(extensions.begin(), extensions.end(), extension) == extensions.end()) extensions.push_back(extension);
}

int Glb::addView(const void* data, size_t bytes, int target) {
    binary.resize((binary.size() + 3) & ~size_t(3));
    json view = {{"buffer", 0}, {"byteOffset", binary.size()}, {"byteLength", bytes}};
    if (target) view["target"] = target;
    const auto* first = static_cast<const uint8_t*>(data);
    binary.insert(binary.end(), first, first + bytes);
    tables->views.push_back(view);
    return int(tables->views.size()) - 1;
}

int Glb::addAccessor(const void* data, size_t count, int components, int componentType, int target) {
    const char* types[] = {"", "SCALAR", "VEC2", "VEC3", "VEC4", "", "", "", "", "", "", "", "", "", "", "", "MAT4"};
    const size_t size = componentType == unsignedShort ? 2 : 4;
    const int view = addView(data, count * size * size_t(components), target);
    tables->accessors.push_back({{"bufferView", view}, {"componentType", componentType}, {"count", count}, {"type", types[components]}});
    return int(tables->accessors.size()) - 1;
}

int Glb::addPicture(const std::string& name, const Picture& picture) {
    const std::vector<uint8_t> file = encodePng(picture);
    const int view = addView(file.data(), file.size(), 0);
    tables->pictures.push_back({{"name", name}, {"bufferView", view}, {"mimeType", "image/png"}});
    tables->textures.push_back({{"source", int(tables->pictures.size()) - 1}, {"sampler", 0}});
    return int(tables->textures.size()) - 1;
}

Material Glb::dressed(Material material, const Textures& painted) {
    material.colorPicture = addPicture(material.name + "_color", painted.color);
    if (!painted.normal.empty()) material.normalPicture = addPicture(material.name + "_normal", painted.normal);
    if (!painted.roughness.empty()) {
        material.roughnessPicture = addPicture(material.name + "_roughness", painted.roughness);
        material.roughness = material.metalness = 1;  // the factors multiply the picture
    }
    return material;
}

int Glb::addMaterial(const Material& m) {
    json surface = {{"baseColorFactor", array(glm::vec4(m.color, m.alpha))},
                    {"metallicFactor", tidy(m.metalness)},
                    {"roughnessFactor", tidy(m.roughness)}};
    if (m.colorPicture != Material::none) surface["baseColorTexture"] = {{"index", m.colorPicture}};
    if (m.roughnessPicture != Material::none) surface["metallicRoughnessTexture"] = {{"index", m.roughnessPicture}};

    json material = {{"name", m.name}, {"pbrMetallicRoughness", surface}};
    if (m.normalPicture != Material::none) material["normalTexture"] = {{"index", m.normalPicture}, {"scale", tidy(m.normalScale)}};
    if (m.mask) material["alphaMode"] = "MASK", material["alphaCutoff"] = 0.5;
    if (m.alpha < 1) material["alphaMode"] = "BLEND";
    if (m.doubleSided) material["doubleSided"] = true;

    json extended = json::object();
    const float strength = std::max({m.emission.r, m.emission.g, m.emission.b});
    if (strength > 0) {
        // emissiveFactor is limited to [0, 1]; the extension carries the rest.
        material["emissiveFactor"] = array(m.emission / std::max(strength, 1.0f));
        if (strength > 1) extended["KHR_materials_emissive_strength"] = {{"emissiveStrength", tidy(strength)}};
    }
    if (m.ior != 1.5f) extended["KHR_materials_ior"] = {{"ior", tidy(m.ior)}};
    if (m.transmission > 0) extended["KHR_materials_transmission"] = {{"transmissionFactor", tidy(m.transmission)}};
    if (m.thickness > 0) {
        extended["KHR_materials_volume"] = {{"thicknessFactor", tidy(m.thickness)}, {"attenuationColor", array(m.attenuation)}};
        if (std::isfinite(m.attenuationDistance)) extended["KHR_materials_volume"]["attenuationDistance"] = tidy(m.attenuationDistance);
    }
    if (m.coat > 0) extended["KHR_materials_clearcoat"] = {{"clearcoatFactor", tidy(m.coat)}, {"clearcoatRoughnessFactor", tidy(m.coatRoughness)}};
    if (m.sheen != glm::vec3(0))
        extended["KHR_materials_sheen"] = {{"sheenColorFactor", array(m.sheen)}, {"sheenRoughnessFactor", tidy(m.sheenRoughness)}};
    if (m.anisotropy > 0)
        extended["KHR_materials_anisotropy"] = {{"anisotropyStrength", tidy(m.anisotropy)}, {"anisotropyRotation", tidy(m.anisotropyRotation)}};
    if (m.specular != 1 || m.specularColor != glm::vec3(1))
        extended["KHR_materials_specular"] = {{"specularFactor", tidy(m.specular)}, {"specularColorFactor", array(m.specularColor)}};
    if (m.unlit) extended["KHR_materials_unlit"] = json::object();
    for (const auto& [name, value] : extended.items()) use(name);
    if (!extended.empty()) material["extensions"] = extended;
    tables->materials.push_back(material);
    return int(tables->materials.size()) - 1;
}

int Glb::addPositions(const std::vector<glm::vec3>& positions) {
    const int accessor = addAccessor(positions.data(), positions.size(), 3, floating, arrayBuffer);
    glm::vec3 low(std::numeric_limits<float>::max()), high(-low);
    for (const glm::vec3& p : positions) low = glm::min(low, p), high = glm::max(high, p);
    // Bounds must equal the stored floats (3.6.2.5), so they aren't rounded.
    tables->accessors.back()["min"] = {low.x, low.y, low.z};
    tables->accessors.back()["max"] = {high.x, high.y, high.z};
    return accessor;
}

int Glb::addGeometry(const Mesh& mesh, const std::vector<glm::vec3>& morphed) {
    const size_t count = mesh.vertices.size();
    const auto gather = [&](int components, auto member) {
        std::vector<float> values;
        values.reserve(count * size_t(components));
        for (const Vertex& v : mesh.vertices)
            for (int k = 0; k < components; ++k) values.push_back((v.*member)[k]);
        return addAccessor(values.data(), count, components, floating, arrayBuffer);
    };

    json attributes;
    std::vector<glm::vec3> positions;
    for (const Vertex& v : mesh.vertices) positions.push_back(v.position);
    attributes["POSITION"] = addPositions(positions);
    attributes["NORMAL"] = gather(3, &Vertex::normal);
    attributes["TEXCOORD_0"] = gather(2, &Vertex::uv);
    if (mesh.hasTangents) attributes["TANGENT"] = gather(4, &Vertex::tangent);
    if (mesh.hasColors) attributes["COLOR_0"] = gather(3, &Vertex::color);

    int indices = 0;
    if (count < 65535) {
        const std::vector<uint16_t> narrow(mesh.indices.begin(), mesh.indices.end());
        indices = addAccessor(narrow.data(), narrow.size(), 1, unsignedShort, elementBuffer);
    } else {
        indices = addAccessor(mesh.indices.data(), mesh.indices.size(), 1, unsignedInt, elementBuffer);
    }
    tables->geometries.push_back({{"attributes", attributes}, {"indices", indices}});
    if (!morphed.empty()) {
        if (morphed.size() != count) throw std::logic_error("a morph target needs a position for each vertex");
        std::vector<glm::vec3> moved;  // a target holds differences (3.7.2.2)
        for (size_t i = 0; i < count; ++i) moved.push_back(morphed[i] - positions[i]);
        tables->geometries.back()["targets"] = json::array({{{"POSITION", addPositions(moved)}}});
    }
    return int(tables->geometries.size()) - 1;
}

void Glb::hold(int geometry, const std::vector<Hold>& holds) {
    json& attributes = tables->geometries.at(size_t(geometry))["attributes"];
    if (holds.size() != tables->accessors.at(attributes["POSITION"].get<size_t>())["count"]) throw std::logic_error("a skin needs a hold for each vertex");
    std::vector<uint16_t> joints;
    std::vector<float> shares;
    for (const Hold& h : holds)
        for (int k = 0; k < 4; ++k) joints.push_back(uint16_t(h.joints[k])), shares.push_back(h.shares[k]);
    attributes["JOINTS_0"] = addAccessor(joints.data(), holds.size(), 4, unsignedShort, arrayBuffer);
    attributes["WEIGHTS_0"] = addAccessor(shares.data(), holds.size(), 4, floating, arrayBuffer);
}

int Glb::addMesh(const std::string& name, const std::vector<std::pair<int, int>>& geometryAndMaterial) {
    json primitives = json::array();
    for (const auto& [geometry, material] : geometryAndMaterial) {
        json primitive = tables->geometries.at(size_t(geometry));
        primitive["material"] = material;
        if (tables->materials.at(size_t(material)).contains("normalTexture") && !primitive["attributes"].contains("TANGENT"))
            throw std::logic_error("mesh '" + name + "': a normal-mapped part has no tangents");
        primitives.push_back(primitive);
    }
    tables->meshes.push_back({{"name", name}, {"primitives", primitives}});
    return int(tables->meshes.size()) - 1;
}

int Glb::addMesh(const std::string& name, const Mesh& mesh, int material) { return addMesh(name, {{addGeometry(mesh), material}}); }

int Glb::addMesh(const Model& model) {
    std::vector<std::pair<int, int>> parts;
    for (const auto& [material, part] : model.parts) {
        Mesh mesh = part;
        if (tables->materials.at(size_t(material)).contains("normalTexture") && !mesh.hasTangents) computeTangents(mesh);
        parts.emplace_back(addGeometry(mesh), material);
    }
    return addMesh(model.name, parts);
}

int Glb::addNode(const std::string& name, int mesh, const Placement& placement) {
    return tables->addPlacedNode({{"name", name}, {"mesh", mesh}}, placement);
}

int Glb::addNode(const Model& model, const Placement& placement) { return addNode(model.name, addMesh(model), placement); }

int Glb::addNode(const LightSource& light, const Placement& placement) {
    const char* kinds[] = {"point", "spot", "directional"};
    json source = {
        {"name", light.name}, {"type", kinds[int(light.kind)]}, {"color", array(light.color)}, {"intensity", tidy(light.intensity)}};
    if (light.kind == LightSource::Kind::spot)
        source["spot"] = {{"innerConeAngle", tidy(glm::radians(light.innerDegrees))},
                          {"outerConeAngle", tidy(glm::radians(light.outerDegrees))}};
    tables->lights.push_back(source);
    use("KHR_lights_punctual");
    return tables->addPlacedNode({{"name", light.name}, {"extensions", {{"KHR_lights_punctual", {{"light", int(tables->lights.size()) - 1}}}}}}, placement);
}

void Glb::addLevels(int node, const std::vector<Level>& levels) {
    json ids = json::array(), errors = json::array({0});
    for (const Level& level : levels) {
        const std::string name = tables->nodes.at(size_t(node)).at("name").get<std::string>() + "_level_" + std::to_string(errors.size());
        json coarser = tables->nodes[size_t(node)];  // it stands where the node stands
        coarser["name"] = name, coarser["mesh"] = level.mesh;
        ids.push_back(tables->nodes.size());
        errors.push_back(tidy(level.error));
        tables->owned.insert(int(tables->nodes.size()));
        tables->nodes.push_back(coarser);
    }
    tables->nodes[size_t(node)]["extensions"]["MSFT_lod"]["ids"] = ids;
    tables->nodes[size_t(node)]["extras"]["lod_error"] = errors;
    use("MSFT_lod");
}

std::vector<int> Glb::addSkin(int node, const std::vector<Joint>& joints) {
    // A skinned mesh stands where its joints stand, whatever its own node says (3.7.3.3), so the skeleton takes the node's place.
    json skeleton = tables->nodes.at(size_t(node));
    skeleton.erase("mesh");
    skeleton["name"] = skeleton["name"].get<std::string>() + " skeleton";
    const int root = int(tables->nodes.size());
    tables->nodes.push_back(skeleton);
    std::vector<int> made;
    std::vector<glm::mat4> toJoints;
    for (const Joint& joint : joints) {
        const bool hangs = joint.parent >= 0;
        const glm::vec3 from = hangs ? joints.at(size_t(joint.parent)).position : glm::vec3(0);
        made.push_back(tables->addPlacedNode({{"name", joint.name}}, {.translation = joint.position - from}));
        tables->nodes[size_t(hangs ? made.at(size_t(joint.parent)) : root)]["children"].push_back(made.back());
        tables->owned.insert(made.back());
        glm::mat4 toJoint(1);
        toJoint[3] = glm::vec4(-joint.position, 1);
        toJoints.push_back(toJoint);
    }
    const int matrices = addAccessor(toJoints.data(), toJoints.size(), 16, floating, 0);
    tables->skins.push_back({{"joints", made}, {"inverseBindMatrices", matrices}});
    tables->nodes[size_t(node)]["skin"] = int(tables->skins.size()) - 1;
    return made;
}

void Glb::animate(int node, Motion motion, const std::vector<float>& seconds, const std::vector<glm::vec4>& values) {
    if (seconds.empty() || seconds.size() != values.size()) throw std::logic_error("an animation needs a value for each of its times");
    const int input = addAccessor(seconds.data(), seconds.size(), 1, floating, 0);
    tables->accessors.back()["min"] = json::array({seconds.front()});  // 3.11: the input of a sampler states its bounds
    tables->accessors.back()["max"] = json::array({seconds.back()});
    const char* paths[] = {"translation", "rotation", "scale", "weights"};
    const int components = motion == Motion::rotation ? 4 : motion == Motion::weight ? 1 : 3;
    std::vector<float> numbers;
    for (const glm::vec4& value : values)
        for (int k = 0; k < components; ++k) numbers.push_back(value[k]);
    const int output = addAccessor(numbers.data(), values.size(), components, floating, 0);
    tables->samplers.push_back({{"input", input}, {"output", output}, {"interpolation", "LINEAR"}});
    tables->channels.push_back({{"sampler", int(tables->samplers.size()) - 1},
                        {"target", {{"node", node}, {"path", paths[int(motion)]}}}});
}

void Glb::write(const std::filesystem::path& path) const {
    json roots = json::array();
    for (size_t i = 0; i < tables->nodes.size(); ++i)
        if (!tables->owned.contains(int(i))) roots.push_back(i);

    json root;
    root["asset"] = {{"version", "2.0"}, {"generator", "lodestir generate_scenes"}};
    root["scene"] = 0;
    root["scenes"] = json::array({{{"nodes", roots}}});
    root["nodes"] = tables->nodes;
    root["meshes"] = tables->meshes;
    root["materials"] = tables->materials;
    root["accessors"] = tables->accessors;
    root["bufferViews"] = tables->views;
    root["buffers"] = json::array({{{"byteLength", binary.size()}}});
    if (!tables->pictures.empty()) {
        root["images"] = tables->pictures;
        root["textures"] = tables->textures;
        root["samplers"] = json::array({{{"magFilter", linear}, {"minFilter", linearMipmapLinear}, {"wrapS", repeat}, {"wrapT", repeat}}});
    }
    if (!tables->channels.empty()) root["animations"] = json::array({{{"channels", tables->channels}, {"samplers", tables->samplers}}});
    if (!tables->skins.empty()) root["skins"] = tables->skins;
    if (!tables->lights.empty()) root["extensions"]["KHR_lights_punctual"]["lights"] = tables->lights;
    if (!extensions.empty()) root["extensionsUsed"] = extensions;

    // Section 4.4: twelve bytes of header, then a JSON chunk padded with spaces and a binary chunk padded with zeros.
    std::string text = root.dump();
    text.resize((text.size() + 3) & ~size_t(3), ' ');
    std::vector<uint8_t> body = binary;
    body.resize((body.size() + 3) & ~size_t(3), 0);

    std::vector<uint8_t> file;
    file.reserve(28 + text.size() + body.size());
    appendWord(file, 0x46546C67);  // "glTF"
    appendWord(file, 2);
    appendWord(file, uint32_t(28 + text.size() + body.size()));
    appendWord(file, uint32_t(text.size()));
    appendWord(file, 0x4E4F534A);  // "JSON"
    file.insert(file.end(), text.begin(), text.end());
    appendWord(file, uint32_t(body.size()));
    appendWord(file, 0x004E4942);  // "BIN"
    file.insert(file.end(), body.begin(), body.end());

    std::filesystem::path aside = path;
    aside += ".part";
    {
        std::ofstream out(aside, std::ios::binary);
        out.write(reinterpret_cast<const char*>(file.data()), std::streamsize(file.size()));
        if (!out.flush()) throw std::runtime_error("cannot write " + aside.string());
    }
    std::filesystem::rename(aside, path);
}

}  // namespace lodestir::generate
