// SPDX-License-Identifier: MIT
// Materials of a glTF model.
#include <framework/scene/gltf/material.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace lodestir {
namespace {

/// A place where a texture is used: the value parsed by tinygltf, or found in an extension.
struct TextureUse {
    int index = -1, uvSet = 0;
    const tinygltf::Value* transform = nullptr;
};

template <class Info> TextureUse useOf(const Info& info) {
    return {info.index, info.texCoord, findExtension(info.extensions, "KHR_texture_transform")};
}

TextureUse useOf(const tinygltf::Value* object, const char* key) {
    if (!object || !object->Has(key) || !object->Get(key).IsObject()) return {};
    const tinygltf::Value& info = object->Get(key);
    TextureUse use{integerOf(&info, "index", -1), integerOf(&info, "texCoord", 0), nullptr};
    if (!info.Has("extensions") || !info.Get("extensions").IsObject()) return use;
    const tinygltf::Value& extensions = info.Get("extensions");
    if (extensions.Has("KHR_texture_transform") && extensions.Get("KHR_texture_transform").IsObject())
        use.transform = &extensions.Get("KHR_texture_transform");
    return use;
}

/// JSON has numbers that no float has.
float finiteOr(double value, float otherwise) {
    const auto result = static_cast<float>(value);
    return std::isfinite(result) ? result : otherwise;
}

glm::vec2 pairOf(const tinygltf::Value* object, const char* key, glm::vec2 otherwise) {
    if (!object || !object->Has(key)) return otherwise;
    const tinygltf::Value& array = object->Get(key);
    if (array.ArrayLen() != 2 || !array.Get(0).IsNumber() || !array.Get(1).IsNumber()) return otherwise;
    return {finiteOr(array.Get(0).GetNumberAsDouble(), otherwise.x), finiteOr(array.Get(1).GetNumberAsDouble(), otherwise.y)};
}

class MaterialLoader {
public:
    MaterialLoader(GltfImport& import, GltfTextures& textures, std::size_t index)
        : import_(import), textures_(textures), source_(import.file.model.materials[index]) {
        material_.name = source_.name.empty() ? fmt::format("material {}", index) : source_.name;
    }

    Material load() {
        readBase();
        readSpecularGlossiness();
        readEmission();
        readVolume();
        readLayers();
        if (source_.alphaMode == "MASK")
            material_.alphaMode = AlphaMode::mask;
        else if (source_.alphaMode == "BLEND")
            material_.alphaMode = AlphaMode::blend;
        else if (source_.alphaMode != "OPAQUE")
            import_.note(fmt::format("\"{}\" is no alpha mode; material \"{}\" is opaque", source_.alphaMode, material_.name));
        material_.alphaCutoff = std::max(static_cast<float>(source_.alphaCutoff), 0.0f);
        material_.doubleSided = source_.doubleSided;
        if (findExtension(source_.extensions, "KHR_materials_unlit")) makeUnlit();
        if (findExtension(source_.extensions, "MSFT_lod"))
            import_.note("levels of detail of materials are ignored; the finest material is used");
        return std::move(material_);
    }

private:
    TextureSlot slot(const TextureUse& use, bool srgb) {
        if (use.index < 0) return {};
        TextureSlot result;
        result.texture = textures_.use(use.index, srgb);
        const int uvSet = integerOf(use.transform, "texCoord", use.uvSet);
        if (uvSet > 1 || uvSet < 0) import_.note("textures that read TEXCOORD_2 or later read TEXCOORD_0 instead");
        result.uvSet = uvSet == 1 ? 1 : 0;
        result.offset = pairOf(use.transform, "offset", {0, 0});
        result.scale = pairOf(use.transform, "scale", {1, 1});
        result.rotation = numberOf(use.transform, "rotation", 0);
        return result;
    }

    void readBase() {
        const auto& pbr = source_.pbrMetallicRoughness;
        for (int i = 0; i < 4; ++i)
            material_.baseColor[i] = std::clamp(static_cast<float>(pbr.baseColorFactor[static_cast<std::size_t>(i)]), 0.0f, 1.0f);
        material_.metallic = std::clamp(static_cast<float>(pbr.metallicFactor), 0.0f, 1.0f);
        material_.roughness = std::clamp(static_cast<float>(pbr.roughnessFactor), 0.0f, 1.0f);
        material_.baseColorMap = slot(useOf(pbr.baseColorTexture), true);
        material_.metallicRoughnessMap = slot(useOf(pbr.metallicRoughnessTexture), false);
        material_.normalMap = slot(useOf(source_.normalTexture), false);
        material_.normalScale = finiteOr(source_.normalTexture.scale, 1);
        material_.occlusionMap = slot(useOf(source_.occlusionTexture), false);
        material_.occlusionStrength = std::clamp(static_cast<float>(source_.occlusionTexture.strength), 0.0f, 1.0f);
    }

    /// The archived model has no exact counterpart: what reflects most of its light in colour becomes a metal, the rest keeps its
    /// diffuse colour.
    void readSpecularGlossiness() {
        const tinygltf::Value* gloss = findExtension(source_.extensions, "KHR_materials_pbrSpecularGlossiness");
        if (!gloss) return;
        import_.note("specular-glossiness materials are approximated by metallic-roughness ones");
        constexpr float brightestDielectric = 0.25f;  // reflectance of diamond is 0.17; metals start near 0.4
        const glm::vec3 specular = vectorOf(gloss, "specularFactor", glm::vec3(1)),
                        diffuse = vectorOf(gloss, "diffuseFactor", glm::vec3(1));
        const bool diffuseMapped = gloss->Has("diffuseTexture"), specularMapped = gloss->Has("specularGlossinessTexture");
        const float brightest = std::max({specular.r, specular.g, specular.b});
        const bool metal =
            !specularMapped && !diffuseMapped && brightest > brightestDielectric && brightest > std::max({diffuse.r, diffuse.g, diffuse.b});
        material_.metallic = metal ? 1.0f : 0.0f;
        material_.roughness = 1 - std::clamp(numberOf(gloss, "glossinessFactor", 1), 0.0f, 1.0f);
        if (specularMapped) material_.roughness = std::max(material_.roughness, 0.5f);  // the map lowers glossiness; its mean is not known
        material_.baseColor = glm::vec4(glm::clamp(metal ? specular : diffuse, 0.0f, 1.0f), 1.0f);
        material_.baseColorMap = slot(useOf(gloss, "diffuseTexture"), true);
        material_.metallicRoughnessMap = {};
    }

    void readEmission() {
        for (int i = 0; i < 3; ++i)
            material_.emission[i] = std::max(finiteOr(source_.emissiveFactor[static_cast<std::size_t>(i)], 0), 0.0f);
        material_.emission *=
            std::max(numberOf(findExtension(source_.extensions, "KHR_materials_emissive_strength"), "emissiveStrength", 1), 0.0f);
        material_.emissiveMap = slot(useOf(source_.emissiveTexture), true);
        if (source_.emissiveTexture.index >= 0 && material_.emissiveMap.texture == none)
            material_.emission = glm::vec3(0);  // the map said where; all of it would be wrong
    }

    void readVolume() {
        const tinygltf::Value* transmission = findExtension(source_.extensions, "KHR_materials_transmission");
        material_.transmission = std::clamp(numberOf(transmission, "transmissionFactor", 0), 0.0f, 1.0f);
        material_.transmissionMap = slot(useOf(transmission, "transmissionTexture"), false);
        const float ior = numberOf(findExtension(source_.extensions, "KHR_materials_ior"), "ior", 1.5f);
        if (ior >= 1)
            material_.ior = ior;
        else
            import_.note("indices of refraction below 1 are replaced by 1.5");

        const tinygltf::Value* volume = findExtension(source_.extensions, "KHR_materials_volume");
        material_.solid = numberOf(volume, "thicknessFactor", 0) > 0;
        material_.attenuationColor = glm::clamp(vectorOf(volume, "attenuationColor", glm::vec3(1)), 0.0f, 1.0f);
        material_.attenuationDistance = std::max(numberOf(volume, "attenuationDistance", 0), 0.0f);
    }

    /// KHR_materials_specular, _sheen, _anisotropy, _clearcoat; a material where none of them does anything stays plain.
    void readLayers() {
        const auto share = [](const tinygltf::Value* object, const char* key, float otherwise) {
            return std::clamp(numberOf(object, key, otherwise), 0.0f, 1.0f);
        };
        MaterialLayers layers;
        bool any = false;
        if (const tinygltf::Value* specular = findExtension(source_.extensions, "KHR_materials_specular")) {
            layers.specular = share(specular, "specularFactor", 1);
            layers.specularColor = glm::max(vectorOf(specular, "specularColorFactor", glm::vec3(1)), 0.0f);
            layers.specularMap = slot(useOf(specular, "specularTexture"), false);
            layers.specularColorMap = slot(useOf(specular, "specularColorTexture"), true);
            any = any || layers.specular < 1 || layers.specularColor != glm::vec3(1) || layers.specularMap.texture != none ||
                  layers.specularColorMap.texture != none;
        }
        if (const tinygltf::Value* sheen = findExtension(source_.extensions, "KHR_materials_sheen")) {
            layers.sheenColor = glm::clamp(vectorOf(sheen, "sheenColorFactor", glm::vec3(0)), 0.0f, 1.0f);
            layers.sheenRoughness = share(sheen, "sheenRoughnessFactor", 0);
            layers.sheenColorMap = slot(useOf(sheen, "sheenColorTexture"), true);
            layers.sheenRoughnessMap = slot(useOf(sheen, "sheenRoughnessTexture"), false);
            any = any || layers.sheenColor != glm::vec3(0);
        }
        if (const tinygltf::Value* anisotropy = findExtension(source_.extensions, "KHR_materials_anisotropy")) {
            layers.anisotropy = share(anisotropy, "anisotropyStrength", 0);
            layers.anisotropyRotation = numberOf(anisotropy, "anisotropyRotation", 0);
            layers.anisotropyMap = slot(useOf(anisotropy, "anisotropyTexture"), false);
            any = any || layers.anisotropy > 0;
        }
        if (const tinygltf::Value* coat = findExtension(source_.extensions, "KHR_materials_clearcoat")) {
            layers.coat = share(coat, "clearcoatFactor", 0);
            layers.coatRoughness = share(coat, "clearcoatRoughnessFactor", 0);
            layers.coatMap = slot(useOf(coat, "clearcoatTexture"), false);
            layers.coatRoughnessMap = slot(useOf(coat, "clearcoatRoughnessTexture"), false);
            layers.coatNormalMap = slot(useOf(coat, "clearcoatNormalTexture"), false);
            if (layers.coatNormalMap.texture != none) layers.coatNormalScale = numberOf(&coat->Get("clearcoatNormalTexture"), "scale", 1);
            any = any || layers.coat > 0;
        }
        if (any) material_.layers = layers;
    }

    /// KHR_materials_unlit: the base colour is what is seen. It is emitted, so that every technique shows it alike, and nothing scatters.
    void makeUnlit() {
        import_.note("unlit materials emit their base colour");
        material_.unlit = true;
        material_.emission = glm::vec3(material_.baseColor);
        material_.emissiveMap = material_.baseColorMap;
        material_.baseColor = glm::vec4(glm::vec3(0), material_.baseColor.a);
        material_.metallic = material_.transmission = 0;
        material_.ior = 1;
        material_.solid = false;
        material_.metallicRoughnessMap = material_.normalMap = material_.transmissionMap = {};
        material_.layers.reset();
    }

    GltfImport& import_;
    GltfTextures& textures_;
    const tinygltf::Material& source_;
    Material material_;
};

}  // namespace

void loadGltfMaterials(GltfImport& import, GltfTextures& textures) {
    import.materialBase = static_cast<std::uint32_t>(import.scene.materials.size());
    for (std::size_t i = 0; i < import.file.model.materials.size(); ++i) {
        Material material = MaterialLoader(import, textures, i).load();
        import.scene.materials.push_back(std::move(material));
    }
}

std::optional<TextureSlot> tangentSlot(const Material& material) {
    if (material.normalMap.texture != none) return material.normalMap;
    if (!material.layers) return std::nullopt;
    const MaterialLayers& layers = *material.layers;
    if (layers.coatNormalMap.texture != none) return layers.coatNormalMap;
    if (layers.anisotropy > 0) return layers.anisotropyMap;
    return std::nullopt;
}

namespace {

/// KHR_materials_variants: the material that the primitive's mappings give to a variant, else its own. -1: none.
int variantMaterial(const tinygltf::Primitive& primitive, int variant) {
    const tinygltf::Value* extension = variant >= 0 ? findExtension(primitive.extensions, "KHR_materials_variants") : nullptr;
    if (!extension || !extension->Has("mappings")) return primitive.material;
    const tinygltf::Value& mappings = extension->Get("mappings");
    for (std::size_t m = 0; m < mappings.ArrayLen(); ++m) {
        const tinygltf::Value& mapping = mappings.Get(m);
        if (!mapping.IsObject() || !mapping.Has("variants")) continue;
        const tinygltf::Value& variants = mapping.Get("variants");
        for (std::size_t v = 0; v < variants.ArrayLen(); ++v) {
            if (variants.Get(v).IsInt() && variants.Get(v).GetNumberAsInt() == variant) return integerOf(&mapping, "material", primitive.material);
        }
    }
    return primitive.material;
}

}  // namespace

std::uint32_t gltfMaterial(GltfImport& import, const tinygltf::Primitive& primitive) {
    const int index = variantMaterial(primitive, import.variant);
    const std::size_t count = import.file.model.materials.size();
    if (index >= 0 && static_cast<std::size_t>(index) < count) return import.materialBase + static_cast<std::uint32_t>(index);
    if (index >= 0) import.note(fmt::format("there is no material {}, the file has {}; what wears it is white", index, count));
    if (import.defaultMaterial == none) {
        import.defaultMaterial = static_cast<std::uint32_t>(import.scene.materials.size());
        import.scene.materials.push_back({.name = "default"});
    }
    return import.defaultMaterial;
}

}  // namespace lodestir
