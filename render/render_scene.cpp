// SPDX-License-Identifier: Apache-2.0
#include <tetralight/render/render_scene.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>
#include <utility>

#include <tetralight/bake/image/srgb.h>
#include <tetralight/bake/scene/mapped_normal.h>
#include <tetralight/bake/scene/surface_color.h>
#include <tetralight/lightmap/sample_lightmap.h>
#include <tetralight/pipeline/lightmap_scene.h>
#include <tetralight/probes/interpolate.h>
#include <tetralight/probes/locate.h>
#include <tetralight/render/shadow_origin.h>
#include <tetralight/runtime/shade.h>

namespace tetralight {
namespace {

/// Limit of back faces that a ray passes, so that a ray that is stuck ends.
constexpr int kMaxCulledFaces = 64;

/// The light of a place on a surface with this unit normal.
PackedSh light_on(const ProbeVolumeView& volume, const glm::vec3& position,
                  const glm::vec3& normal) {
    const CellLocation location = locate(volume, position);
    const glm::vec3 pushed = push_off_surface(volume, position, normal, location);
    return pack_sh(interpolate(volume, locate(volume, pushed, location.cell)).irradiance);
}

glm::vec3 encoded(const glm::vec3& color) {
    return {srgb_from_linear(color.x), srgb_from_linear(color.y), srgb_from_linear(color.z)};
}

}  // namespace

SceneShader::SceneShader(const Scene& scene, const ProbeVolumeView& volume, SceneLight light,
                         TraceScene traced, TraceScene moving)
    : scene_(&scene),
      volume_(volume),
      light_(std::move(light)),
      mirror_(light_.reflections, light_.has_box_projection),
      traced_(std::move(traced)),
      moving_(std::move(moving)) {
    for (RuntimeLight& runtime : light_.lights) {
        runtime.light = traced_.render_from_world(runtime.light);
    }
}

Result<SceneShader> SceneShader::make(const Scene& scene, const ProbeVolumeView& volume,
                                      ProbeLight probes) {
    auto light = make_scene_light(scene, volume, probes);
    if (!light) return light.error();
    return make(scene, volume, std::move(*light));
}

Result<SceneShader> SceneShader::make(const Scene& scene, const ProbeVolumeView& volume,
                                      SceneLight light) {
    auto traced = TraceScene::make(scene, [](const MeshInstance&) { return true; });
    if (!traced) return traced.error();
    auto moving = TraceScene::make(
        scene, [](const MeshInstance& instance) { return !instance.contributes_gi; });
    if (!moving) return moving.error();
    return SceneShader(scene, volume, std::move(light), std::move(*traced), std::move(*moving));
}

PackedSh SceneShader::probe_light(const Surface& surface) const {
    const InstanceLight& instance = light_.instances[surface.instance];
    switch (instance.use) {
        case ProbeUse::Off:
            break;
        case ProbeUse::Given:
            return instance.light;
        case ProbeUse::ProxyVolume: {
            const glm::vec3 world(traced_.world_from_render(surface.position));
            const Lppv& lppv = light_.proxy_volumes[instance.proxy_volume];
            return pack_sh(sample_lppv(lppv, world).irradiance);
        }
        case ProbeUse::EachPoint:
        case ProbeUse::Lightmap:  // the back of a surface
            return light_on(volume_, glm::vec3(traced_.world_from_render(surface.position)),
                            surface.geometric_normal);
    }
    return {};
}

glm::vec2 SceneShader::page_uv_at(const Surface& surface) const {
    return page_uv_of(light_.lightmaps, *scene_, surface.instance, surface.primitive,
                      traced_.world_from_render(surface.position));
}

bool SceneShader::has_lightmap(const Surface& surface) const {
    return light_.instances[surface.instance].use == ProbeUse::Lightmap && !surface.is_from_behind;
}

glm::vec3 SceneShader::normal_with_map(const Surface& surface) const {
    const MeshInstance& instance = scene_->instances[surface.instance];
    const Mesh& mesh = scene_->meshes[instance.mesh];
    if (!has_normal_map(*scene_, mesh)) return surface.shading_normal;
    const float side = surface.is_from_behind ? -1.0f : 1.0f;
    const MeshPoint point = mesh_point(mesh, surface.primitive, surface.barycentric);
    return side * mapped_normal(*scene_, point, glm::mat3(instance.world_from_mesh),
                                side * surface.shading_normal);
}

glm::vec3 SceneShader::baked_light(const Surface& surface, const glm::vec3& base_normal) const {
    if (has_lightmap(surface)) return lightmap_light(surface, base_normal);
    const glm::vec3 light = sample_sh9(probe_light(surface), surface.shading_normal);
    return glm::max(light, glm::vec3(0.0f));
}

glm::vec3 SceneShader::lightmap_light(const Surface& surface, const glm::vec3& base_normal) const {
    const LightmapsView& maps = light_.lightmaps;
    const uint32_t page = maps.rectangles[surface.instance].page;
    const glm::vec2 uv = page_uv_at(surface);
    const bool is_directional = light_.lightmap_light == LightmapLight::Directional &&
                                surface.shading_normal != base_normal;
    const glm::vec3 irradiance =
        is_directional ? sample_lightmap(maps, page, uv, {base_normal, surface.shading_normal})
                       : sample_irradiance(maps, page, uv);
    glm::vec3 light = irradiance * std::numbers::inv_pi_v<float>;
    const glm::vec3 origin = TraceScene::ray_origin(surface, surface.geometric_normal);
    const glm::dvec3 world_origin = traced_.world_from_render(origin);
    for (const RuntimeLight& runtime : light_.lights) {
        const bool subtracts =
            runtime.lights_moving && lightmap_shadow(maps, runtime) == LightmapShadow::InTexels;
        if (!subtracts) continue;
        const Illumination arriving = illuminate(runtime.light, surface.position);
        const bool is_lit =
            !occluded(world_origin, arriving.to_light, arriving.distance, Casters::Moving);
        light = subtract_shadow(light, direct_light(arriving, surface.shading_normal),
                                is_lit ? 1.0f : 0.0f, light_.shadow_color);
    }
    return light_.has_ambient_occlusion ? light * sample_ambient_occlusion(maps, page, uv) : light;
}

glm::vec3 SceneShader::direct_term(const Surface& surface) const {
    const bool moves = !scene_->instances[surface.instance].contributes_gi;
    const bool is_mapped = has_lightmap(surface);
    const glm::dvec3 world_origin =
        traced_.world_from_render(shadow_origin(*scene_, traced_, surface));
    glm::vec4 mask(1.0f);
    if (is_mapped) {
        const LightmapsView& maps = light_.lightmaps;
        mask =
            sample_shadow_mask(maps, maps.rectangles[surface.instance].page, page_uv_at(surface));
    }
    glm::vec3 sum(0.0f);
    for (size_t i = 0; i < light_.lights.size(); ++i) {
        const RuntimeLight& runtime = light_.lights[i];
        if (moves && !runtime.lights_moving) continue;
        const LightmapShadow shadow =
            is_mapped ? lightmap_shadow(light_.lightmaps, runtime) : LightmapShadow::RealTime;
        if (shadow == LightmapShadow::InTexels) continue;
        glm::vec3 direct = direct_light(runtime.light, surface.position, surface.shading_normal);
        const bool has_static_shadow =
            shadow == LightmapShadow::Mask || (moves && runtime.channel != kNoIndex);
        direct *= light_.instances[surface.instance].visibility[i];
        if (shadow == LightmapShadow::Mask) direct *= runtime.visibility(mask);
        if (direct == glm::vec3(0.0f)) continue;
        const Illumination arriving = illuminate(runtime.light, surface.position);
        const bool is_shadowed = occluded(world_origin, arriving.to_light, arriving.distance,
                                          has_static_shadow ? Casters::Moving : Casters::All);
        if (!is_shadowed) sum += direct;
    }
    return sum;
}

std::optional<Surface> SceneShader::first_front_face(glm::vec3 origin, glm::vec3 direction) const {
    std::optional<Surface> surface = traced_.intersect({origin, direction});
    for (int i = 0; surface && surface->is_back_face && i < kMaxCulledFaces; ++i) {
        const glm::vec3 behind = TraceScene::ray_origin(*surface, -surface->geometric_normal);
        surface = traced_.intersect({behind, direction});
    }
    return surface;
}

glm::vec3 SceneShader::emitted(const Surface& surface) const {
    const uint32_t material = scene_->meshes[scene_->instances[surface.instance].mesh].material;
    return surface.emission * light_.emission_weights[material];
}

glm::vec3 SceneShader::shiny_light(const Surface& surface, const glm::vec3& base_normal,
                                   glm::vec3 direction) const {
    const Mesh& mesh = scene_->meshes[scene_->instances[surface.instance].mesh];
    if (scene_->materials[mesh.material].is_unlit) return glm::vec3(0.0f);
    const ShinySurface shiny =
        shiny_surface(*scene_, mesh_point(mesh, surface.primitive, surface.barycentric));
    const glm::vec3 baked = baked_light(surface, base_normal);
    const MirrorPoint point{traced_.world_from_render(surface.position), surface.shading_normal,
                            -direction, shiny.f0, shiny.roughness};
    return shiny.diffuse * (baked + direct_term(surface)) + mirror_.radiance(point, baked);
}

glm::vec3 SceneShader::show(const Surface& surface, const glm::vec3& base_normal,
                            glm::vec3 direction, SurfaceView view) const {
    switch (view) {
        case SurfaceView::Shaded:
            if (mirror_.has_probes())
                return emitted(surface) + shiny_light(surface, base_normal, direction);
            return emitted(surface) +
                   surface.albedo * (baked_light(surface, base_normal) + direct_term(surface));
        case SurfaceView::Received:
            return baked_light(surface, base_normal) + direct_term(surface);
        case SurfaceView::Direct:
            return surface.albedo * direct_term(surface);
        case SurfaceView::Bounce:
            return surface.albedo * baked_light(surface, base_normal);
        case SurfaceView::Emission:
            return emitted(surface);
        case SurfaceView::Albedo:
            return encoded(surface.albedo);
        case SurfaceView::Normal:
            return 0.5f + 0.5f * surface.shading_normal;
        default:
            break;
    }
    constexpr glm::vec3 kNoLightmap(0.2f);
    if (light_.instances[surface.instance].use != ProbeUse::Lightmap) return kNoLightmap;
    return lightmap_color(view, light_.lightmaps, surface.instance, page_uv_at(surface));
}

std::optional<SceneShader::Shaded> SceneShader::shade(const glm::dvec3& origin, glm::vec3 direction,
                                                      SurfaceView view) const {
    const glm::vec3 render_origin = traced_.render_from_world(origin);
    auto surface = first_front_face(render_origin, direction);
    if (!surface) return std::nullopt;
    const float distance = glm::distance(render_origin, surface->position);
    const glm::vec3 base_normal = surface->shading_normal;
    surface->shading_normal = normal_with_map(*surface);
    return Shaded{show(*surface, base_normal, glm::normalize(direction), view), distance};
}

std::optional<float> SceneShader::distance(const glm::dvec3& origin, glm::vec3 direction) const {
    const glm::vec3 render_origin = traced_.render_from_world(origin);
    const auto surface = first_front_face(render_origin, direction);
    if (!surface) return std::nullopt;
    return glm::distance(render_origin, surface->position);
}

bool SceneShader::occluded(const glm::dvec3& origin, glm::vec3 direction, float distance,
                           Casters objects) const {
    const TraceScene& traced = casters(objects);
    return traced.occluded({traced.render_from_world(origin), direction, distance});
}

glm::vec3 sky_radiance(const ProbeVolumeView& volume, glm::vec3 direction) {
    return glm::max(evaluate_radiance(radiance_from_irradiance(volume.info.ambient), direction),
                    glm::vec3(0.0f));
}

Result<ImageF> render_scene(const Scene& scene, const ProbeVolumeView& volume, const Camera& camera,
                            const RenderSettings& settings, const LightmapsView& lightmaps) {
    auto light = make_scene_light(scene, volume, ProbeLight::AsTheScene, lightmaps);
    if (!light) return light.error();
    const auto shader = SceneShader::make(scene, volume, std::move(*light));
    if (!shader) return shader.error();
    return render_view(camera, settings, [&](const glm::dvec3& origin, glm::vec3 direction) {
        const auto shaded = shader->shade(origin, direction);
        return shaded ? shaded->radiance : sky_radiance(volume, direction);
    });
}

}  // namespace tetralight
