// SPDX-License-Identifier: Apache-2.0
#include <tetralight/pipeline/bake_key.h>

#include <span>
#include <string_view>
#include <type_traits>

#include <tetralight/bake/lightmap/make_radiance_cache.h>
#include <tetralight/lightmap/lightmap_file.h>
#include <tetralight/probes/content_hash.h>
#include <tetralight/probes/probe_file.h>

// Every struct is taken apart by a structured binding: a member that is added to it does not
// compile here until someone says whether the bake depends on it.

namespace tetralight {
namespace {

/// SHA-256 with the calls of `ContentHash`.
class KeyHash {
  public:
    template <class T>
    void add(const T& value) {
        static_assert(std::is_trivially_copyable_v<T>);
        hash_.add(std::as_bytes(std::span(&value, 1)));
    }

    template <class T>
    void add(const std::vector<T>& values) {
        add(static_cast<uint64_t>(values.size()));
        hash_.add(std::as_bytes(std::span(values)));
    }

    void add(std::string_view text) {
        add(static_cast<uint64_t>(text.size()));
        hash_.add(text);
    }

    [[nodiscard]] Sha256Digest digest() const { return hash_.digest(); }

  private:
    Sha256 hash_;
};

template <class Hash>
void add(Hash& hash, const TextureUse& use) {
    const auto& [texture, uv_set, image_from_mesh] = use;
    hash.add(texture);
    hash.add(uv_set);
    hash.add(image_from_mesh);
}

template <class Hash>
void add(Hash& hash, const Material& material) {
    const auto& [name, base_color, base_color_texture, metallic, roughness,
                 metallic_roughness_texture, emission, emission_texture, alpha_mode, alpha_cutoff,
                 is_double_sided, is_unlit, bakes_emission, normal_texture, normal_scale] =
        material;
    hash.add(base_color);
    add(hash, base_color_texture);
    hash.add(metallic);
    hash.add(roughness);
    add(hash, metallic_roughness_texture);
    hash.add(emission);
    add(hash, emission_texture);
    hash.add(alpha_mode);
    hash.add(alpha_cutoff);
    hash.add(is_double_sided);
    hash.add(is_unlit);
    hash.add(bakes_emission);
}

template <class Hash>
void add(Hash& hash, const Texture& texture) {
    const auto& [name, image, wrap_u, wrap_v] = texture;
    hash.add(image.width);
    hash.add(image.height);
    hash.add(image.pixels);
    hash.add(wrap_u);
    hash.add(wrap_v);
}

template <class Hash>
void add(Hash& hash, const Mesh& mesh) {
    const auto& [positions, normals, uvs, colors, tangents, indices, material] = mesh;
    hash.add(positions);
    hash.add(normals);
    for (const auto& set : uvs) hash.add(set);
    hash.add(colors);
    hash.add(indices);
    hash.add(material);
}

template <class Hash>
void add(Hash& hash, const MeshInstance& instance) {
    const auto& [mesh, world_from_mesh, name, contributes_gi, node, is_walkable, is_in_reflections,
                 lightmap] = instance;
    hash.add(mesh);
    hash.add(world_from_mesh);
    hash.add(contributes_gi);
}

template <class Hash>
void add(Hash& hash, const Environment& environment) {
    const auto& [radiance, image, rotation_radians] = environment;
    hash.add(radiance);
    hash.add(image.width);
    hash.add(image.height);
    hash.add(image.pixels);
    hash.add(rotation_radians);
}

template <class Hash>
void add(Hash& hash, const Portal& portal) {
    const auto& [name, center, along, across] = portal;
    hash.add(center);
    hash.add(along);
    hash.add(across);
}

/// The name decides between volumes of the same size.
template <class Hash>
void add(Hash& hash, const ProbeAdjustment& adjustment) {
    const auto& [name, shape, world_from_volume, forbids_probes, spacing, validity, intensity,
                 rendering_layers] = adjustment;
    hash.add(std::vector<char>(name.begin(), name.end()));
    hash.add(shape);
    hash.add(world_from_volume);
    hash.add(validity.value_or(-1.0f));
    hash.add(intensity.value_or(-1.0f));
}

template <class Hash, class T>
void add_each(Hash& hash, const std::vector<T>& elements) {
    hash.add(static_cast<uint64_t>(elements.size()));
    for (const T& element : elements) add(hash, element);
}

template <class Hash>
void add(Hash& hash, const Scene& scene) {
    const auto& [textures, normal_maps, materials, meshes, instances, nodes, lights, light_names,
                 environment, cameras, probe_groups, probe_adjustments, portals, reflection_places,
                 parts, memory, choice, warnings] = scene;
    add_each(hash, textures);
    add_each(hash, materials);
    add_each(hash, meshes);
    add_each(hash, instances);
    hash.add(lights);
    add(hash, environment);
    add_each(hash, portals);
}

template <class Hash>
void add(Hash& hash, const LightPlan& plan) {
    const auto& [light_modes, layer_of_light, layer_of_material, layer_of_sky, layer_count,
                 has_rest, has_transfer, has_occlusion, ambient_occlusion_distance] = plan;
    hash.add(light_modes);
    hash.add(layer_of_light);
    hash.add(layer_of_material);
    hash.add(layer_of_sky);
    hash.add(layer_count);
    hash.add(has_rest);
    hash.add(has_transfer);
    hash.add(has_occlusion);
    hash.add(ambient_occlusion_distance);
}

template <class Hash>
void add(Hash& hash, const BakeSettings& settings) {
    const auto& [sample_count, target_error, target_layer_error, max_sample_count,
                 time_budget_seconds, clamp, bounces, surfaces, plan, seed, thread_count] =
        settings;
    hash.add(sample_count);
    hash.add(target_error);
    hash.add(target_layer_error);
    hash.add(max_sample_count);
    hash.add(time_budget_seconds);
    hash.add(clamp);
    hash.add(bounces);
    hash.add(surfaces.albedo_boost);
    hash.add(surfaces.max_albedo);
    add(hash, plan);
    hash.add(seed);
}

template <class Hash>
void add(Hash& hash, const std::vector<TexelMap>& maps) {
    for (const TexelMap& map : maps) {
        hash.add(map.width);
        hash.add(map.charts);
        hash.add(map.texels);
    }
}

/// Merge and health settings show in the volume, lighting in the volume and in the plan.
template <class Hash>
void add(Hash& hash, const BakeVolumeSettings& settings) {
    const auto& [merge, bake, health, dering, lighting] = settings;
    add(hash, bake);
    hash.add(health.invalid);
    hash.add(dering.window);
    hash.add(dering.is_for_all_groups);
}

}  // namespace

uint64_t scene_key(const Scene& scene) {
    ContentHash hash;
    add(hash, scene);
    return hash.value();
}

uint64_t adjustments_key(const std::vector<ProbeAdjustment>& adjustments) {
    ContentHash hash;
    add_each(hash, adjustments);
    return hash.value();
}

Sha256Digest light_key(const Scene& scene, const BakeSettings& settings) {
    KeyHash hash;
    hash.add(std::string_view("light of probes 4, tetralight " TETRALIGHT_VERSION));
    add(hash, scene);
    add(hash, settings);
    return hash.digest();
}

uint64_t bake_key(const PreparedBake& prepared) {
    ContentHash hash;
    add(hash, prepared.settings);
    hash.add(probe_file_bytes(prepared.volume.view()));
    hash.add(prepared.capture_positions);
    for (const bool is_invalid : prepared.is_invalid) hash.add(is_invalid);
    hash.add(prepared.overrides);
    for (const bool dering : prepared.merged.group_dering) hash.add(dering);
    return hash.value();
}

uint64_t cache_key(const PreparedLightmaps& prepared) {
    ContentHash hash;
    hash.add(prepared.layout.texels_per_meter);
    for (const LightmapPacking& packing : prepared.layout.packings)
        hash.add(packing.charts.corner_uvs);
    for (const LightmapPlace& place : prepared.layout.places) hash.add(place.packing);
    add(hash, prepared.maps);
    const auto& [positions, surfaces, origins, validity, first_texel] = prepared.texels;
    hash.add(positions);
    hash.add(surfaces);
    hash.add(origins);
    const auto& [direct_sample_count, path_count] = RadianceCacheSettings();
    hash.add(direct_sample_count);
    hash.add(path_count);
    return hash.value();
}

uint64_t lightmap_key(const PreparedLightmaps& prepared) {
    ContentHash hash;
    add(hash, prepared.settings.bake);
    hash.add(lightmap_file_bytes(prepared.lightmaps.view()));
    add(hash, prepared.maps);
    if (prepared.has_cache()) hash.add(cache_key(prepared));
    hash.add(prepared.texels.validity);
    hash.add(prepared.texels.origins);
    hash.add(prepared.baked);
    hash.add(prepared.positions);
    hash.add(prepared.surfaces);
    if (!prepared.mapped_normals.empty()) hash.add(prepared.mapped_normals);
    for (const Seam& seam : prepared.seams) {
        hash.add(seam.first);
        hash.add(seam.second);
    }
    return hash.value();
}

}  // namespace tetralight
