// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/reflection/path_cubes.h>

#include <utility>

#include <tetralight/bake/lights/scene_openings.h>
#include <tetralight/bake/path_light_groups.h>

namespace tetralight {

Result<PathCubes> PathCubes::make(const Scene& scene, const BakeSettings& settings) {
    auto trace_scene = TraceScene::make_static(scene, settings.surfaces);
    if (!trace_scene) return trace_scene.error();
    return PathCubes(scene, std::move(*trace_scene), settings);
}

PathCubes::PathCubes(const Scene& scene, TraceScene trace_scene, const BakeSettings& settings)
    : trace_scene_(std::make_unique<const TraceScene>(std::move(trace_scene))) {
    const PathSettings paths{settings.bounces, settings.clamp};
    std::vector<Opening> openings;
    if (paths.traces_all_light()) openings = openings_of(scene, *trace_scene_);
    tracer_ = std::make_unique<const PathTracer>(scene, *trace_scene_, paths, settings.plan,
                                                 std::move(openings));
    for (const MeshInstance& instance : scene.instances)
        is_hidden_.push_back(!instance.is_in_reflections);
}

PathStart PathCubes::start(const glm::dvec3& position, glm::vec3 direction, float spread) const {
    return {.origin = trace_scene_->render_from_world(position),
            .direction = direction,
            .spread = spread,
            .is_hidden = &is_hidden_};
}

CubeSample PathCubes::sample(const glm::dvec3& position, glm::vec3 direction, float spread,
                             const Sampler& sampler, std::span<glm::vec3> layers) const {
    const PathStart ray = start(position, direction, spread);
    if (layers.empty()) {
        const PathSample path = tracer_->trace(ray, sampler);
        return {path.radiance, path.hit_back_face, path.ray_count};
    }
    PathLightGroups groups(static_cast<uint32_t>(layers.size()));
    const PathSample path = tracer_->trace(ray, sampler, &groups);
    for (uint32_t i = 0; i < layers.size(); ++i) layers[i] = groups.radiance(i);
    return {path.radiance, path.hit_back_face, path.ray_count};
}

std::optional<Surface> PathCubes::first_surface(const glm::dvec3& position, glm::vec3 direction,
                                                float spread, uint32_t& ray_count) const {
    return tracer_->first_surface(start(position, direction, spread), ray_count);
}

}  // namespace tetralight
