// SPDX-License-Identifier: MIT
#include <framework/scene/upload/world.h>

#include <framework/core/error.h>
#include <framework/scene/axes.h>
#include <framework/scene/upload/environment_table.h>
#include <framework/scene/level_policy.h>
#include <framework/scene/upload/light_list.h>
#include <framework/scene/upload/mipmaps.h>
#include <framework/scene/panes.h>

#include <glm/gtc/matrix_access.hpp>

#include <algorithm>
#include <cmath>

namespace lodestir {
namespace {

TextureSlotRecord slotRecord(const TextureSlot& slot) {
    const float c = std::cos(slot.rotation), s = std::sin(slot.rotation);
    return {.texture = slot.texture,
            .uvSet = slot.uvSet,
            .row0 = {c * slot.scale.x, s * slot.scale.y, slot.offset.x},
            .row1 = {-s * slot.scale.x, c * slot.scale.y, slot.offset.y}};
}

LayersRecord layersRecord(const MaterialLayers& l) {
    LayersRecord r{.specularColor = l.specularColor,
                   .specular = l.specular,
                   .sheenColor = l.sheenColor,
                   .sheenRoughness = l.sheenRoughness,
                   .anisotropyDirection = {std::cos(l.anisotropyRotation), std::sin(l.anisotropyRotation)},
                   .anisotropy = l.anisotropy,
                   .coat = l.coat,
                   .coatRoughness = l.coatRoughness,
                   .coatNormalScale = l.coatNormalScale};
    r.maps[LAYER_SPECULAR] = slotRecord(l.specularMap);
    r.maps[LAYER_SPECULAR_COLOR] = slotRecord(l.specularColorMap);
    r.maps[LAYER_SHEEN_COLOR] = slotRecord(l.sheenColorMap);
    r.maps[LAYER_SHEEN_ROUGHNESS] = slotRecord(l.sheenRoughnessMap);
    r.maps[LAYER_ANISOTROPY] = slotRecord(l.anisotropyMap);
    r.maps[LAYER_COAT] = slotRecord(l.coatMap);
    r.maps[LAYER_COAT_ROUGHNESS] = slotRecord(l.coatRoughnessMap);
    r.maps[LAYER_COAT_NORMAL] = slotRecord(l.coatNormalMap);
    return r;
}

MaterialRecord materialRecord(const Material& m, bool vertexColor) {
    MaterialRecord r{};
    r.baseColor = m.baseColor;
    r.emission = m.emission;
    r.metallic = m.metallic;
    r.roughness = m.roughness;
    r.normalScale = m.normalScale;
    r.transmission = m.transmission;
    r.ior = m.ior;
    // KHR_materials_volume: transmittance over the attenuation distance is the attenuation colour (Beer-Lambert).
    if (m.attenuationDistance > 0) r.attenuation = -glm::log(glm::max(m.attenuationColor, glm::vec3(1e-6f))) / m.attenuationDistance;
    r.alphaCutoff = m.alphaCutoff;
    r.flags = (m.doubleSided ? MATERIAL_DOUBLE_SIDED : 0) | (m.alphaMode == AlphaMode::mask ? MATERIAL_MASK : 0) |
              (m.alphaMode == AlphaMode::blend ? MATERIAL_BLEND : 0) | (m.solid ? MATERIAL_SOLID : 0) |
              (m.emission != glm::vec3(0) ? MATERIAL_EMISSIVE : 0) | (vertexColor ? MATERIAL_VERTEX_COLOR : 0) |
              (m.unlit ? MATERIAL_UNLIT : 0) | (isPane(m) ? MATERIAL_PANE : 0);
    r.layers = NONE;
    r.baseColorMap = slotRecord(m.baseColorMap);
    r.metallicRoughnessMap = slotRecord(m.metallicRoughnessMap);
    r.normalMap = slotRecord(m.normalMap);
    r.emissiveMap = slotRecord(m.emissiveMap);
    r.transmissionMap = slotRecord(m.transmissionMap);
    return r;
}

std::uint32_t textureFlags(const Texture& t) {
    const auto wrap = [](Wrap w, std::uint32_t clamp, std::uint32_t mirror) { return w == Wrap::clamp ? clamp : w == Wrap::mirror ? mirror : 0u; };
    return (t.srgb ? TEXTURE_SRGB : 0) | (t.nearest ? TEXTURE_NEAREST : 0) | wrap(t.wrapU, TEXTURE_CLAMP_U, TEXTURE_MIRROR_U) |
           wrap(t.wrapV, TEXTURE_CLAMP_V, TEXTURE_MIRROR_V);
}

void putRows(const glm::mat4& matrix, vec4* rows) {
    for (int r = 0; r < 3; ++r) rows[r] = glm::row(matrix, r);
}

/// Does the matrix leave a mesh its volume? Those that leave it an area have a shaper (scene/flattening.h); of others there is nothing to be seen.
bool isInvertible(const glm::mat4& matrix) {
    const double volume = glm::determinant(glm::dmat3(matrix));
    return volume != 0 && std::isfinite(volume);
}

/// Does nothing turn inside out, or lose its volume, on the straight way from one matrix to the other? By the signs of the volume on the way.
bool keepsSide(const glm::mat4& from, const glm::mat4& to) {
    const glm::dmat3 a(from), b(to);
    for (int i = 1; i <= 8; ++i)
        if (!(glm::determinant(a) * glm::determinant(a + (b - a) * (i / 8.0)) > 0)) return false;
    return true;
}

CameraRecord cameraRecord(const CameraKey& camera, glm::uvec2 size) {
    CameraRecord record{};
    const ViewAxes axes = viewAxes(camera);
    const bool orthographic = camera.height > 0;
    const float height = orthographic ? 0.5f * camera.height : std::tan(0.5f * camera.fovy);
    record.position = camera.position;
    record.aperture = orthographic ? 0 : camera.aperture;
    record.right = axes.right * (height * float(size.x) / float(size.y));
    record.up = axes.up * height;
    record.forward = axes.forward;
    record.orthographic = orthographic;
    record.focus = camera.focus;
    record.pixelAngle = 2 * height / float(size.y);
    return record;
}

}  // namespace

/// Where positions, normals and boxes lie. Where meshes deform each pose has its own.
struct WorldBuilder::Shapes {
    VkDeviceAddress triangles = 0, positions = 0, vertices = 0;
    std::vector<gpu::Buffer> posed;
    gpu::Buffer meshes;
};

/// What never changes.
struct WorldBuilder::Fixed {
    std::shared_ptr<const Geometry> geometry;
    gpu::Buffer roots, levels, materials, layers, textures, texels, environment;
};

/// What follows the pose of one frame.
struct WorldBuilder::Moving {
    std::shared_ptr<const Shapes> shapes;
    std::shared_ptr<const BottomLevels::Table> bottomLevels;
    gpu::Array<BvhNode> nodes;
    gpu::Buffer traceInstances, instances, closing, lights, lightLevels;
    bool moves = false;  ///< some instance, while the shutter is open
    glm::vec3 gridBase{0}, gridScale{1}, center{0};
    std::uint32_t topRoot = bvh_ref::empty, lightCount = 0, lightRecords = 0, environmentLight = NONE;
    float radius = 1;
};

/// Of each instance.
struct WorldBuilder::Levels {
    std::vector<std::uint32_t> values;
    gpu::Buffer buffer;
};

WorldBuilder::WorldBuilder(const gpu::Device& device, const Scene& scene, bool rayQuery)
    : device_(device), scene_(scene), geometry_(std::make_shared<Geometry>(scene, &device)) {
    auto fixed = std::make_shared<Fixed>();
    fixed->geometry = geometry_;
    std::vector<MaterialRecord> materials;
    std::vector<LayersRecord> layers;
    for (std::size_t i = 0; i < scene.materials.size(); ++i) {
        materials.push_back(materialRecord(scene.materials[i], geometry_->vertexColor[i]));
        if (!scene.materials[i].layers) continue;
        materials.back().layers = std::uint32_t(layers.size());
        layers.push_back(layersRecord(*scene.materials[i].layers));
    }
    std::vector<std::uint32_t> texels;
    std::vector<TextureRecord> textures;
    for (const Texture& texture : scene.textures) {
        const std::size_t first = texels.size();
        const std::uint32_t mips = appendMipmaps(texture, texels);
        textures.push_back({first * 4, std::uint32_t(texture.width), std::uint32_t(texture.height), mips, textureFlags(texture)});
    }

    const auto upload = [&]<class T>(const std::vector<T>& values, const char* name) { return gpu::makeBuffer(device_, std::span<const T>(values), name); };
    fixed->roots = upload(geometry_->roots, "roots");
    fixed->levels = upload(geometry_->levels, "mesh levels");
    fixed->materials = upload(materials, "materials");
    fixed->layers = upload(layers, "material layers");
    fixed->texels = upload(texels, "texels");
    for (TextureRecord& texture : textures) texture.texels += fixed->texels.address();
    fixed->textures = upload(textures, "textures");
    fixed->environment = upload(environmentTable(scene.environment), "environment");
    fixed_ = std::move(fixed);
    if (!scene.deforms()) shapes_ = uploadShapes();
    if (rayQuery) bottomLevels_ = std::make_unique<BottomLevels>(device, *geometry_);
}

std::shared_ptr<const WorldBuilder::Shapes> WorldBuilder::uploadShapes() const {
    auto shapes = std::make_shared<Shapes>();
    const auto place = [&]<class T>(const gpu::Array<T>& array, const char* name) {
        if (array.buffer()) return array.buffer().address();
        return shapes->posed.emplace_back(gpu::makeBuffer(device_, array.values(), name)).address();
    };
    shapes->triangles = place(geometry_->triangles, "triangles");
    shapes->positions = place(geometry_->positions, "positions");
    shapes->vertices = place(geometry_->vertices, "vertices");
    shapes->meshes = gpu::makeBuffer(device_, std::span<const MeshRecord>(geometry_->meshes), "meshes");
    return shapes;
}

WorldBuilder::~WorldBuilder() = default;

SceneRecords WorldBuilder::records() const {
    const Geometry& g = *geometry_;
    return {g.levels, g.primitives.values(), g.vertices.values(), g.positions.values()};
}

std::shared_ptr<const WorldBuilder::Moving> WorldBuilder::makeMoving(const Pose& pose, const Pose& end) {
    auto moving = std::make_shared<Moving>();
    if (scene_.deforms()) geometry_->pose(scene_, pose);
    moving->shapes = shapes_ ? shapes_ : uploadShapes();
    if (bottomLevels_ && (scene_.deforms() || !moving_))
        moving->bottomLevels = bottomLevels_->build(scene_, *geometry_, moving->shapes->positions);
    else if (moving_)
        moving->bottomLevels = moving_->bottomLevels;
    std::vector<Box> boxes;
    std::vector<TraceInstance> traced;
    std::vector<InstanceRecord> records;
    std::vector<glm::vec4> closing(3 * scene_.instances.size());
    Box all;
    for (const Instance& instance : scene_.instances) {
        const glm::mat4 toWorld = scene_.instanceMatrix(instance, pose.nodes);
        InstanceRecord record{};
        record.mesh = instance.mesh;
        putRows(toWorld, record.toWorld);
        if (!isInvertible(toWorld)) {
            record.flags = INSTANCE_HIDDEN;
            boxes.emplace_back();
            traced.push_back({.mesh = instance.mesh});
            records.push_back(record);
            continue;
        }
        boxes.push_back(transformed(geometry_->bounds[instance.mesh], toWorld));
        traced.push_back(traceInstance(instance.mesh, geometry_->grids[instance.mesh], toWorld));
        record.rounding = traceRounding(toWorld);
        const std::vector<glm::mat4> joints = jointMatrices(scene_, scene_.meshes[instance.mesh], pose.nodes);
        record.flags = glm::determinant(glm::mat3(joints.empty() ? toWorld : joints[0])) < 0 ? INSTANCE_MIRRORED : 0;
        if (const glm::mat4 there = scene_.instanceMatrix(instance, end.nodes); there != toWorld && keepsSide(toWorld, there)) {
            record.flags |= INSTANCE_MOVES;
            moving->moves = true;
            putRows(there, &closing[3 * records.size()]);
            // Points go straight, so what they sweep lies between. A ray's way there is rounded once more on its way to where the instance was.
            boxes.back().add(transformed(geometry_->bounds[instance.mesh], there));
            record.rounding = 2.0f * glm::max(record.rounding, traceRounding(there));
        }
        all.add(boxes.back());
        records.push_back(record);
    }
    if (!all.isEmpty()) {
        moving->center = 0.5f * (all.low + all.high);
        moving->radius = std::max(0.5f * glm::length(all.high - all.low), 1e-6f);
    }
    const auto positions = [&](std::size_t mesh, std::size_t level) { return geometry_->positionsOf(mesh, level); };
    const LightList lights = listLights(scene_, geometry_->emitters, positions, pose.nodes, moving->radius);
    for (std::size_t i = 0; i < records.size(); ++i) {
        records[i].firstLight = lights.firstLight[i];
        records[i].coarserLights = lights.coarserLights[i];
    }

    const Bvh top = buildTopLevel(boxes);
    const std::size_t below = geometry_->nodes.size();
    moving->nodes = {&device_, below + top.nodes.size(), "nodes"};
    std::ranges::copy(geometry_->nodes, moving->nodes.values().begin());
    moving->gridBase = top.gridBase;
    moving->gridScale = top.gridScale;
    moving->topRoot = top.root == bvh_ref::empty ? top.root : placeNodes(top, below, 0, moving->nodes.values().subspan(below));
    moving->nodes.upload();
    if (scene_.animation.empty()) geometry_->nodes = {};  // there is no other pose
    moving->traceInstances = gpu::makeBuffer(device_, std::span<const TraceInstance>(traced), "trace instances");
    moving->instances = gpu::makeBuffer(device_, std::span<const InstanceRecord>(records), "instances");
    if (moving->moves) moving->closing = gpu::makeBuffer(device_, std::span<const glm::vec4>(closing), "instances, as the shutter closes");
    moving->lights = gpu::makeBuffer(device_, std::span<const LightRecord>(lights.lights), "lights");
    moving->lightLevels = gpu::makeBuffer(device_, std::span<const std::uint32_t>(lights.levels), "light levels");
    moving->lightCount = lights.count;
    moving->lightRecords = std::uint32_t(lights.lights.size());
    moving->environmentLight = lights.environmentLight;
    return moving;
}

void WorldBuilder::moveTo(float frame, float shutter) {
    Pose opening = poseAt(scene_, frame), closing = shutter > 0 ? poseAt(scene_, frame + shutter) : opening;
    if (moving_ && opening == opening_ && closing == closing_) return;
    moving_ = makeMoving(opening, closing);
    opening_ = std::move(opening);
    closing_ = std::move(closing);
}

World WorldBuilder::placedWorld() const {
    World w{};
    w.nodes = moving_->nodes.buffer().address();
    w.triangles = moving_->shapes->triangles;
    w.traceInstances = moving_->traceInstances.address();
    w.roots = fixed_->roots.address();
    w.bottomLevels = moving_->bottomLevels ? moving_->bottomLevels->addresses.address() : 0;
    w.gridBase = moving_->gridBase;
    w.gridScale = moving_->gridScale;
    w.topRoot = moving_->topRoot;
    w.instanceCount = std::uint32_t(scene_.instances.size());
    w.instances = moving_->instances.address();
    w.closing = moving_->moves ? moving_->closing.address() : 0;
    w.primitives = geometry_->primitives.buffer().address();
    w.meshLevels = fixed_->levels.address();
    w.meshes = moving_->shapes->meshes.address();
    w.emitters = geometry_->emitterIndices.buffer().address();
    w.positions = moving_->shapes->positions;
    w.vertices = moving_->shapes->vertices;
    w.materials = fixed_->materials.address();
    w.layers = fixed_->layers.address();
    w.textures = fixed_->textures.address();
    w.lights = moving_->lights.address();
    w.lightLevels = moving_->lightLevels.address();
    w.environment = fixed_->environment.address();
    w.environmentSize = {scene_.environment.width, scene_.environment.height};
    w.environmentRotation = scene_.environment.rotation;
    w.environmentLight = moving_->environmentLight;
    w.lightCount = moving_->lightCount;
    w.lightRecords = moving_->lightRecords;
    w.sceneRadius = moving_->radius;
    w.sceneCenter = moving_->center;
    return w;
}

FrameWorld WorldBuilder::at(float frame, glm::uvec2 size, float shutter) {
    if (shutter > 0 && bottomLevels_)
        throw Error("the shutter is open, and rays that the driver traces see nothing move", "trace them by packet or lane: --rays lane; or set shutter to 0");
    moveTo(frame, shutter);
    std::vector<std::uint32_t> levels = levelsAt(scene_, frame);
    if (!levels_ || levels != levels_->values) {
        std::vector<std::uint32_t> words = levels;
        words.push_back(1);  // levelsChanged: this is made anew only where they do
        gpu::Buffer buffer = gpu::makeBuffer(device_, std::span<const std::uint32_t>(words), "levels");
        levels_ = std::make_shared<const Levels>(Levels{std::move(levels), std::move(buffer)});
    }
    World w = placedWorld();
    if (scene_.deforms()) frames_[w.positions] = frame;
    w.levels = levels_->buffer.address();
    w.levelsChanged = w.levels + levels_->values.size() * sizeof(std::uint32_t);
    w.camera = cameraRecord(scene_.cameraAt(frame), size);
    w.closingCamera = cameraRecord(scene_.cameraAt(frame + shutter), size);
    struct Keep {
        std::shared_ptr<const Fixed> fixed;
        std::shared_ptr<const Moving> moving;
        std::shared_ptr<const Levels> levels;
    };
    return {w, std::make_shared<Keep>(Keep{fixed_, moving_, levels_})};
}

FrameWorld WorldBuilder::objects(const World* posed) {
    const auto known = posed ? frames_.find(posed->positions) : frames_.end();
    moveTo(known == frames_.end() ? 0 : known->second);
    std::vector<TraceInstance> traced;
    std::vector<InstanceRecord> records;
    for (std::uint32_t m = 0; m < scene_.meshes.size(); ++m) {
        const glm::mat4 untransformed(1);
        traced.push_back(traceInstance(m, geometry_->grids[m], untransformed));
        InstanceRecord& record = records.emplace_back();
        record.mesh = m;
        record.firstLight = record.coarserLights = NONE;
        record.rounding = traceRounding(untransformed);
        putRows(untransformed, record.toWorld);
    }
    struct Keep {
        std::shared_ptr<const Fixed> fixed;
        std::shared_ptr<const Moving> moving;
        gpu::Buffer traceInstances, instances, levels;
    };
    const std::vector<std::uint32_t> finest(records.size() + 1, 0);  // and levelsChanged
    auto keep = std::make_shared<Keep>(Keep{fixed_, moving_, gpu::makeBuffer(device_, std::span<const TraceInstance>(traced), "trace objects"),
                                            gpu::makeBuffer(device_, std::span<const InstanceRecord>(records), "objects"),
                                            gpu::makeBuffer(device_, std::span<const std::uint32_t>(finest), "levels of objects")});
    World w = placedWorld();
    w.traceInstances = keep->traceInstances.address();
    w.instances = keep->instances.address();
    w.levels = keep->levels.address();
    w.levelsChanged = w.levels + records.size() * sizeof(std::uint32_t);
    w.instanceCount = std::uint32_t(records.size());
    w.topRoot = bvh_ref::empty;
    w.lightCount = w.lightRecords = 0;
    w.environmentLight = NONE;
    return {w, keep};
}

}  // namespace lodestir
