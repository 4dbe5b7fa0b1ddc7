// SPDX-License-Identifier: MIT
#include <framework/scene/world.h>

#include <framework/core/log.h>
#include <framework/scene/alias_table.h>
#include <framework/scene/bvh.h>
#include <framework/scene/environment_table.h>
#include <framework/scene/level_policy.h>
#include <framework/scene/light_list.h>
#include <framework/scene/mesh_bvh.h>
#include <framework/scene/mipmaps.h>
#include <framework/scene/pack.h>

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
              (m.emission != glm::vec3(0) ? MATERIAL_EMISSIVE : 0) | (vertexColor ? MATERIAL_VERTEX_COLOR : 0);
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

Box transformed(const Box& box, const glm::mat4& matrix) {
    if (box.low.x > box.high.x) return box;
    Box out;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::vec3 p(corner & 1 ? box.high.x : box.low.x, corner & 2 ? box.high.y : box.low.y, corner & 4 ? box.high.z : box.low.z);
        const glm::vec3 q(matrix * glm::vec4(p, 1));
        out.low = glm::min(out.low, q);
        out.high = glm::max(out.high, q);
    }
    return out;
}

void putRows(const glm::mat4& matrix, vec4* rows) {
    for (int r = 0; r < 3; ++r) rows[r] = glm::row(matrix, r);
}

CameraRecord cameraRecord(const CameraKey& camera, glm::uvec2 size) {
    CameraRecord record{};
    const glm::vec3 forward = glm::normalize(camera.target - camera.position);
    glm::vec3 right = glm::cross(forward, camera.up);
    if (glm::dot(right, right) < 1e-12f) right = glm::cross(forward, glm::vec3(0, 0, 1));  // looking straight along `up`
    right = glm::normalize(right);
    const float height = std::tan(0.5f * camera.fovy);
    record.position = camera.position;
    record.aperture = camera.aperture;
    record.right = right * (height * float(size.x) / float(size.y));
    record.up = glm::cross(right, forward) * height;
    record.forward = forward;
    record.focus = camera.focus;
    record.pixelAngle = 2 * height / float(size.y);
    return record;
}

}  // namespace

/// What never changes. Mesh-level data lies one level after the other.
struct WorldBuilder::Fixed {
    std::vector<BvhNode> nodes;  // of all mesh levels; kept so that a top level can be set behind them
    std::vector<Box> bounds, grids;  // of each mesh: box over its levels; grid base and scale
    std::vector<MeshEmitters> emitters;
    gpu::Buffer triangles, roots, levels, meshes, primitives, emitterIndices, positions, vertices, materials, textures, texels, environment;
    std::size_t bytes = 0;
};

/// What follows the transforms of one frame.
struct WorldBuilder::Moving {
    gpu::Buffer nodes, traceInstances, instances, lights;
    glm::vec3 gridBase{0}, gridScale{1}, center{0};
    std::uint32_t topRoot = bvh_ref::empty, lightCount = 0, environmentLight = NONE;
    float radius = 1;
};

/// Of each instance.
struct WorldBuilder::Levels {
    std::vector<std::uint32_t> values;
    gpu::Buffer buffer;
};

WorldBuilder::WorldBuilder(const gpu::Device& device, const Scene& scene) : device_(device), scene_(scene) {
    auto fixed = std::make_shared<Fixed>();
    std::vector<BvhTriangle> triangles;
    std::vector<std::uint32_t> roots(scene.meshes.size() * LEVELS, bvh_ref::empty), emitterIndices;
    std::vector<LevelRecord> levels(scene.meshes.size() * LEVELS);
    std::vector<MeshRecord> meshes;
    std::vector<PrimitiveRecord> primitives;
    std::vector<glm::vec3> positions;
    std::vector<VertexRecord> vertices;
    std::vector<bool> vertexColor(scene.materials.size(), false);

    log::Progress progress("building BVHs", scene.meshes.size());
    for (std::size_t m = 0; m < scene.meshes.size(); ++m, progress.advance()) {
        const Mesh& mesh = scene.meshes[m];
        const Box box = boundsOf(mesh);
        fixed->bounds.push_back(box);
        fixed->emitters.emplace_back();
        Box grid;
        for (std::size_t l = 0; l < mesh.levels.size(); ++l) {
            const MeshLevel& level = mesh.levels[l];
            const Bvh bvh = meshBvh(scene, mesh, l);
            grid = {bvh.gridBase, bvh.gridScale};
            const auto firstTriangle = std::uint32_t(triangles.size());
            const auto firstVertex = std::uint32_t(positions.size());
            roots[m * LEVELS + l] = appendNodes(bvh, fixed->nodes, firstTriangle);
            levels[m * LEVELS + l] = {firstTriangle, std::uint32_t(bvh.triangles.size()), level.error};
            triangles.insert(triangles.end(), bvh.triangles.begin(), bvh.triangles.end());
            for (std::uint32_t t : bvh.order) {
                const glm::uvec3 corners = level.triangles[t];
                const std::uint32_t material = level.materials[t];
                std::uint32_t emitter = NONE;
                if (l == 0 && scene.materials[material].emission != glm::vec3(0)) {
                    MeshEmitters& list = fixed->emitters.back();
                    emitter = std::uint32_t(list.primitives.size());
                    list.primitives.push_back(std::uint32_t(primitives.size()));
                    list.triangles.push_back(corners);
                    list.materials.push_back(material);
                }
                emitterIndices.push_back(emitter);
                primitives.push_back({firstVertex + corners.x, firstVertex + corners.y, firstVertex + corners.z, material});
                if (!level.colors.empty()) vertexColor[material] = true;
            }
            positions.insert(positions.end(), level.positions.begin(), level.positions.end());
            for (std::size_t v = 0; v < level.positions.size(); ++v)
                vertices.push_back({.normal = packNormal(level.normals[v]),
                                    .tangent = level.tangents.empty() ? 0 : packTangent(level.tangents[v]),
                                    .uv0 = level.uv0.empty() ? glm::vec2(0) : level.uv0[v],
                                    .uv1 = level.uv1.empty() ? glm::vec2(0) : level.uv1[v],
                                    .color = level.colors.empty() ? ~0u : packColor(level.colors[v])});
        }
        // Levels that a mesh does not have show its coarsest; a mesh that emits always shows its finest, because the list of
        // lights is made of that one's triangles.
        const std::size_t last = fixed->emitters.back().empty() ? mesh.levels.size() - 1 : 0;
        for (std::size_t l = last + 1; l < LEVELS; ++l) {
            roots[m * LEVELS + l] = roots[m * LEVELS + last];
            levels[m * LEVELS + l] = levels[m * LEVELS + last];
        }
        const bool empty = box.low.x > box.high.x;
        meshes.push_back({.center = empty ? glm::vec3(0) : 0.5f * (box.low + box.high),
                          .radius = empty ? 0 : 0.5f * glm::length(box.high - box.low),
                          .levels = std::uint32_t(last + 1)});
        fixed->grids.push_back(grid);
    }

    std::vector<MaterialRecord> materials;
    for (std::size_t i = 0; i < scene.materials.size(); ++i) materials.push_back(materialRecord(scene.materials[i], vertexColor[i]));
    std::vector<std::uint32_t> texels;
    std::vector<TextureRecord> textures;
    for (const Texture& texture : scene.textures) {
        const std::size_t first = texels.size();
        const std::uint32_t mips = appendMipmaps(texture, texels);
        textures.push_back({first * 4, std::uint32_t(texture.width), std::uint32_t(texture.height), mips, textureFlags(texture)});
    }

    const auto upload = [&]<class T>(const std::vector<T>& values, const char* name) {
        gpu::Buffer buffer = gpu::makeBuffer(device_, std::span<const T>(values), name);
        fixed->bytes += buffer.size();
        return buffer;
    };
    triangles.emplace_back();  // packets load 64 bytes at a time: the last triangle's load must end in readable memory
    fixed->triangles = upload(triangles, "triangles");
    fixed->roots = upload(roots, "roots");
    fixed->levels = upload(levels, "mesh levels");
    fixed->meshes = upload(meshes, "meshes");
    fixed->primitives = upload(primitives, "primitives");
    fixed->emitterIndices = upload(emitterIndices, "emitters");
    fixed->positions = upload(positions, "positions");
    fixed->vertices = upload(vertices, "vertices");
    fixed->materials = upload(materials, "materials");
    fixed->texels = upload(texels, "texels");
    for (TextureRecord& texture : textures) texture.texels += fixed->texels.address();
    fixed->textures = upload(textures, "textures");
    fixed->environment = upload(environmentTable(scene.environment), "environment");
    fixed->bytes += fixed->nodes.size() * sizeof(BvhNode);
    fixed_ = std::move(fixed);
}

WorldBuilder::~WorldBuilder() = default;

std::size_t WorldBuilder::memoryBytes() const { return fixed_->bytes; }

std::shared_ptr<const WorldBuilder::Moving> WorldBuilder::makeMoving(const std::vector<glm::mat4>& matrices) const {
    auto moving = std::make_shared<Moving>();
    std::vector<Box> boxes;
    std::vector<TraceInstance> traced;
    std::vector<InstanceRecord> records;
    Box all;
    for (const Instance& instance : scene_.instances) {
        const glm::mat4& toWorld = matrices[instance.node];
        const glm::mat4 toObject = glm::inverse(toWorld);
        boxes.push_back(transformed(fixed_->bounds[instance.mesh], toWorld));
        all.low = glm::min(all.low, boxes.back().low);
        all.high = glm::max(all.high, boxes.back().high);
        const Box& grid = fixed_->grids[instance.mesh];  // low: base, high: scale
        traced.push_back(traceInstance(instance.mesh, grid.low, grid.high, toWorld));
        InstanceRecord record{};
        putRows(toWorld, record.toWorld);
        putRows(toObject, record.toObject);
        record.mesh = instance.mesh;
        record.flags = glm::determinant(glm::mat3(toWorld)) < 0 ? INSTANCE_MIRRORED : 0;
        records.push_back(record);
    }
    if (all.low.x <= all.high.x) {
        moving->center = 0.5f * (all.low + all.high);
        moving->radius = std::max(0.5f * glm::length(all.high - all.low), 1e-6f);
    }
    const LightList lights = listLights(scene_, fixed_->emitters, matrices, moving->radius);
    for (std::size_t i = 0; i < records.size(); ++i) records[i].firstLight = lights.firstLight[i];

    const Bvh top = buildTopLevel(boxes);
    std::vector<BvhNode> nodes = fixed_->nodes;
    moving->gridBase = top.gridBase;
    moving->gridScale = top.gridScale;
    moving->topRoot = top.root == bvh_ref::empty ? top.root : appendNodes(top, nodes, 0);
    moving->nodes = gpu::makeBuffer(device_, std::span<const BvhNode>(nodes), "nodes");
    moving->traceInstances = gpu::makeBuffer(device_, std::span<const TraceInstance>(traced), "trace instances");
    moving->instances = gpu::makeBuffer(device_, std::span<const InstanceRecord>(records), "instances");
    moving->lights = gpu::makeBuffer(device_, std::span<const LightRecord>(lights.lights), "lights");
    moving->lightCount = std::uint32_t(lights.lights.size());
    moving->environmentLight = lights.environmentLight;
    return moving;
}

FrameWorld WorldBuilder::at(float frame, glm::uvec2 size) {
    std::vector<glm::mat4> matrices = scene_.nodeMatrices(frame);
    if (!moving_ || matrices != matrices_) {
        moving_ = makeMoving(matrices);
        matrices_ = std::move(matrices);
    }
    std::vector<std::uint32_t> levels = levelsAt(scene_, frame);
    if (!levels_ || levels != levels_->values) {
        std::vector<std::uint32_t> marked = levels;
        marked.push_back(1);  // they differ from those before: made anew only then
        gpu::Buffer buffer = gpu::makeBuffer(device_, std::span<const std::uint32_t>(marked), "levels");
        levels_ = std::make_shared<const Levels>(std::move(levels), std::move(buffer));
    }
    World w{};
    w.nodes = moving_->nodes.address();
    w.triangles = fixed_->triangles.address();
    w.traceInstances = moving_->traceInstances.address();
    w.roots = fixed_->roots.address();
    w.levels = levels_->buffer.address();
    w.gridBase = moving_->gridBase;
    w.gridScale = moving_->gridScale;
    w.topRoot = moving_->topRoot;
    w.instanceCount = std::uint32_t(scene_.instances.size());
    w.instances = moving_->instances.address();
    w.primitives = fixed_->primitives.address();
    w.meshLevels = fixed_->levels.address();
    w.meshes = fixed_->meshes.address();
    w.emitters = fixed_->emitterIndices.address();
    w.positions = fixed_->positions.address();
    w.vertices = fixed_->vertices.address();
    w.materials = fixed_->materials.address();
    w.textures = fixed_->textures.address();
    w.lights = moving_->lights.address();
    w.environment = fixed_->environment.address();
    w.environmentSize = {scene_.environment.width, scene_.environment.height};
    w.environmentRotation = scene_.environment.rotation;
    w.environmentLight = moving_->environmentLight;
    w.lightCount = moving_->lightCount;
    w.sceneRadius = moving_->radius;
    w.sceneCenter = moving_->center;
    w.camera = cameraRecord(scene_.cameraAt(frame), size);
    struct Keep {
        std::shared_ptr<const Fixed> fixed;
        std::shared_ptr<const Moving> moving;
        std::shared_ptr<const Levels> levels;
    };
    return {w, std::make_shared<Keep>(Keep{fixed_, moving_, levels_})};
}

}  // namespace lodestir
