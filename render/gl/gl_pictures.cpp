// SPDX-License-Identifier: Apache-2.0
#include <tetralight/render/gl/gl_pictures.h>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <optional>
#include <utility>

#include <tetralight/bake/scene/scene_bounds.h>

namespace tetralight {
namespace {

constexpr uint32_t kBallSubdivisions = 3;

/// A sphere (xyz: center, w: radius) that holds all balls.
std::optional<glm::dvec4> bounds_of(std::span<const LightBall> balls) {
    std::optional<WorldBox> box;
    for (const LightBall& ball : balls) {
        const WorldBox bounds{ball.center - double{ball.radius}, ball.center + double{ball.radius}};
        box = box ? union_of(*box, bounds) : bounds;
    }
    if (!box) return std::nullopt;
    return glm::dvec4(box->center(), 0.5 * glm::length(box->size()));
}

/// Renders the scene with balls by a member function of the renderer.
template <class Image>
Result<Image> draw(Renderer& renderer, std::span<const LightBall> balls,
                   Result<Image> (Renderer::*draw)(const Camera&, const RenderSettings&,
                                                   std::span<const SphereInstances>),
                   const Camera& camera, const RenderSettings& settings) {
    InstanceBuffer instances = make_light_balls(renderer, balls, kBallSubdivisions);
    SphereInstances spheres{&instances, balls.size(),     kBallSubdivisions,
                            kNoIndex,   CastsShadows::No, bounds_of(balls)};
    return (renderer.*draw)(camera, settings, std::span(&spheres, 1));
}

}  // namespace

Result<GlPictures> GlPictures::make(const Scene& scene, const ProbeVolumeView& volume,
                                    const SceneLight& light) {
    auto context = OffscreenContext::create();
    if (!context) return context.error();
    return make(std::move(*context), scene, volume, light);
}

Result<GlPictures> GlPictures::make(OffscreenContext context, const Scene& scene,
                                    const ProbeVolumeView& volume, const SceneLight& light) {
    auto renderer = Renderer::make(scene, volume, light, {.shadow_map_size = 4096});
    if (!renderer) return renderer.error();
    return GlPictures(std::move(context), std::move(*renderer));
}

PictureSource GlPictures::source() {
    PictureSource source;
    source.radiance = [this](const Camera& camera, const RenderSettings& settings,
                             std::span<const LightBall> balls) {
        return draw(renderer_, balls, &Renderer::render, camera, settings);
    };
    source.depth = [this](const Camera& camera, const RenderSettings& settings,
                          std::span<const LightBall> balls) {
        return draw(renderer_, balls, &Renderer::depth, camera, settings);
    };
    return source;
}

InstanceBuffer make_light_balls(const Renderer& renderer, std::span<const LightBall> balls,
                                uint32_t subdivisions) {
    InstanceBuffer instances(balls.size());
    const auto memory = instances.begin_write();
    for (size_t i = 0; i < balls.size(); ++i) {
        GlInstance instance;
        const glm::dvec3 scale(double{balls[i].radius});
        const glm::dvec3 place = balls[i].center - renderer.origin();
        set_transform(instance, glm::scale(glm::translate(glm::dmat4(1.0), place), scale));
        instance.color = glm::vec4(glm::vec3(1.0f / 0.96f), 1.0f);  // diffuse albedo is 0.96 of it
        instance.factors = glm::vec4(0.0f);
        instance.use = ProbeUse::Given;
        instance.direct = DirectUse::None;
        instance.material = renderer.sphere_material(subdivisions);
        instance.is_round = 1;
        instance.light = pack_sh(balls[i].light);
        memory[i] = instance;
    }
    return instances;
}

}  // namespace tetralight
