// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <optional>
#include <span>
#include <vector>

#include <tetralight/base/result.h>
#include <tetralight/render/draw_lines.h>
#include <tetralight/render/gl/debug_messages.h>
#include <tetralight/render/gl/instance_buffer.h>
#include <tetralight/render/gl/lightmap_textures.h>
#include <tetralight/render/gl/proxy_textures.h>
#include <tetralight/render/gl/reflection_textures.h>
#include <tetralight/render/gl/render_target.h>
#include <tetralight/render/gl/renderer_shaders.h>
#include <tetralight/render/gl/scene_meshes.h>
#include <tetralight/render/gl/shadow_maps.h>
#include <tetralight/render/gl/volume_buffers.h>
#include <tetralight/render/image_renderer.h>
#include <tetralight/render/scene_light.h>

// A small forward renderer in OpenGL 4.5. It shades by the same `SceneLight` as `SceneShader`, so
// that the pictures of both agree. A context must be current during its lifetime.
//
//     const auto context = OffscreenContext::create();
//     auto renderer = Renderer::make(scene, volume, *make_scene_light(scene, volume, {}));
//     const auto radiance = renderer->render(camera, settings, {});
//     const Image8 picture = develop(*radiance, settings.exposure);

namespace tetralight {

namespace detail {
class ClipSpace;
}

enum class CastsShadows : bool { No, Yes };

/// Spheres that are drawn with the scene: instances of a unit sphere.
struct SphereInstances {
    InstanceBuffer* instances = nullptr;
    /// Number of instances that are drawn, from the first.
    size_t count = 0;
    /// 0 to 4; a sphere has 20 · 4^subdivisions triangles.
    uint32_t subdivisions = 3;
    /// For instances that are lit by a proxy volume: index into `SceneLight::proxy_volumes`.
    uint32_t proxy_volume = kNoIndex;
    CastsShadows casts_shadows = CastsShadows::Yes;
    /// A sphere that holds all of them (xyz: center, w: radius, world space). Empty if
    /// `RendererSettings::sphere_bounds` holds them.
    std::optional<glm::dvec4> bounds = std::nullopt;
};

struct RendererSettings {
    /// Width and height of a shadow map in texels.
    uint32_t shadow_map_size = 2048;
    /// Spheres (xyz: center, w: radius, world space) that bound all `SphereInstances` that cast
    /// shadows.
    std::span<const glm::dvec4> sphere_bounds = {};
};

class Renderer {
  public:
    /// Copies `volume` and `scene` into OpenGL buffers. Returns the errors of the driver.
    [[nodiscard]] static Result<Renderer> make(const Scene& scene, const ProbeVolumeView& volume,
                                               const SceneLight& light,
                                               const RendererSettings& settings = {});

    /// Radiance as from `render_view`. With `samples_per_axis` 1 there is one sample a pixel, else
    /// four or more.
    [[nodiscard]] Result<ImageF> render(const Camera& camera, const RenderSettings& settings,
                                        std::span<const SphereInstances> spheres);

    /// Depth as from `render_depth`.
    [[nodiscard]] Result<DepthImage> depth(const Camera& camera, const RenderSettings& settings,
                                           std::span<const SphereInstances> spheres);

    /// Draws a frame (shadow maps, surfaces, sky) and resolves `target`.
    [[nodiscard]] Status draw(const Camera& camera, const RenderTarget& target,
                              std::span<const SphereInstances> spheres);

    /// World position of the origin of render space, to which the transforms of instances lead.
    [[nodiscard]] const glm::dvec3& origin() const noexcept { return origin_; }

    /// Index of the material of sphere instances: white, roughness 1, metallic 1, to be scaled by
    /// the factors of each instance.
    [[nodiscard]] uint32_t sphere_material(uint32_t subdivisions) const {
        return meshes_.sphere(subdivisions);
    }

  private:
    /// Consecutive instances of one mesh and one proxy volume.
    struct Batch {
        uint32_t mesh = 0;
        uint32_t first = 0;
        uint32_t count = 0;
        uint32_t proxy_volume = kNoIndex;
        bool is_mirrored = false;
        bool moves = false;
        glm::vec3 center{0.0f};
    };

    enum class Pass : uint8_t { Depth, MaskedDepth, Lit, Blended };

    Renderer(const Scene& scene, const ProbeVolumeView& volume, const SceneLight& light,
             const RendererSettings& settings, RendererShaders shaders, DebugMessages messages);

    void add_instances(const Scene& scene, const SceneLight& light);
    void draw_shadows(std::span<const SphereInstances> spheres);
    void draw_depth(const glm::mat4& clip_from_space, std::span<const SphereInstances> spheres);
    void draw_surfaces(std::span<const SphereInstances> spheres);
    void draw_blended(const Camera& camera);
    void draw_batch(const Batch& batch, Pass pass);
    void draw_spheres(const SphereInstances& group, Pass pass);
    void write_frame(const Camera& camera, const RenderTarget& target);
    [[nodiscard]] detail::ClipSpace clip_space(const Camera& camera, const RenderTarget& target,
                                               std::span<const SphereInstances> spheres) const;
    [[nodiscard]] glm::mat4 clip_from_space(const Camera& camera,
                                            const detail::ClipSpace& clip) const;

    DebugMessages messages_;
    RendererShaders shaders_;
    glm::dvec3 origin_;
    /// A sphere around the scene and the spheres that cast shadows (xyz: center, w: radius).
    glm::vec4 bounds_{0.0f, 0.0f, 0.0f, 1.0f};
    PackedSh sky_{};
    VolumeBuffers volume_;
    SceneMeshes meshes_;
    std::vector<Batch> batches_;
    std::vector<ProxyTextures> proxies_;
    LightmapTextures lightmaps_;
    ReflectionTextures reflections_;
    bool has_box_projection_ = true;
    glm::vec3 shadow_color_{0.0f};
    InstanceBuffer instances_;
    ShadowMaps shadows_;
    GlBuffer frame_;
};

}  // namespace tetralight
