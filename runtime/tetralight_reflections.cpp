// SPDX-License-Identifier: Apache-2.0
#include <bit>
#include <cmath>
#include <cstring>
#include <glm/gtc/type_ptr.hpp>

#include <tetralight/reflection/reflection_file.h>
#include <tetralight/reflection/sample_reflections.h>
#include <tetralight/reflection/split_sum.h>
#include <tetralight/runtime/detail/c_arrays.h>
#include <tetralight/runtime/detail/c_open.h>
#include <tetralight/runtime/tetralight.h>

struct tetralight_reflections {
    tetralight::ReflectionFile file;
};

namespace {

using namespace tetralight;
using detail::CallError;
using detail::check_floats;
using detail::check_pointer;
using detail::finish;
using detail::succeed;

static_assert(sizeof(tetralight_reflection_blend) == sizeof(ReflectionBlend));

CallError check_position(const double* position) {
    if (auto wrong = check_pointer("position", position)) return wrong;
    for (int i = 0; i < 3; ++i) {
        if (std::isfinite(position[i])) continue;
        return {TETRALIGHT_BAD_VALUE, str_cat("position[", i, "] is not finite: ", position[i])};
    }
    return {};
}

/// Probes are tested where they are used.
CallError check_blend(const tetralight_reflections* reflections,
                      const tetralight_reflection_blend* blend) {
    if (auto wrong = check_pointer("reflections", reflections)) return wrong;
    if (auto wrong = check_pointer("blend", blend)) return wrong;
    return check_floats("blend->weights", blend->weights, 3);
}

ReflectionBlend blend_of(const tetralight_reflection_blend& from) {
    return std::bit_cast<ReflectionBlend>(from);
}

CallError check_unit(const char* name, float number) {
    if (number >= 0.0f && number <= 1.0f) return {};
    return {TETRALIGHT_BAD_VALUE, str_cat(name, " is not in 0 to 1: ", number)};
}

CallError not_there(const char* what, uint32_t index, size_t count) {
    return {TETRALIGHT_NOT_THERE, str_cat(what, ' ', index, " is not there; there are ", count)};
}

}  // namespace

tetralight_status tetralight_reflections_open(const char* path,
                                              tetralight_reflections** reflections,
                                              tetralight_error* error) noexcept {
    return detail::open_path(open_reflection_file, path, "reflections", reflections, error);
}

tetralight_status tetralight_reflections_open_memory(const void* bytes, size_t size,
                                                     tetralight_reflections** reflections,
                                                     tetralight_error* error) noexcept {
    return detail::open_bytes(open_reflection_memory, bytes, size, "reflections", reflections,
                              error);
}

void tetralight_reflections_close(tetralight_reflections* reflections) noexcept {
    delete reflections;
}

tetralight_status tetralight_reflections_get_info(const tetralight_reflections* reflections,
                                                  tetralight_reflections_info* info,
                                                  tetralight_error* error) noexcept {
    if (auto wrong = check_pointer("reflections", reflections)) return finish(wrong, error);
    if (auto wrong = check_pointer("info", info)) return finish(wrong, error);
    const ReflectionsView& view = reflections->file.view();
    *info = {view.size, view.level_count, static_cast<uint32_t>(view.probes.size())};
    return succeed(error);
}

tetralight_status tetralight_reflections_get_probe(const tetralight_reflections* reflections,
                                                   uint32_t index,
                                                   tetralight_reflection_probe* probe,
                                                   tetralight_error* error) noexcept {
    if (auto wrong = check_pointer("reflections", reflections)) return finish(wrong, error);
    if (auto wrong = check_pointer("probe", probe)) return finish(wrong, error);
    const auto probes = reflections->file.view().probes;
    if (index >= probes.size()) return finish(not_there("probe", index, probes.size()), error);
    const ReflectionProbe& found = probes[index];
    std::memcpy(probe->position, &found.position, sizeof probe->position);
    std::memcpy(probe->box_center, &found.box_center, sizeof probe->box_center);
    std::memcpy(probe->half_size, &found.half_size, sizeof probe->half_size);
    std::memcpy(probe->axes, &found.axes, sizeof probe->axes);
    probe->blend_distance = found.blend_distance;
    probe->importance = found.importance;
    probe->validity = found.validity;
    return succeed(error);
}

tetralight_status tetralight_reflections_texels(const tetralight_reflections* reflections,
                                                uint32_t level, tetralight_const_array* texels,
                                                tetralight_error* error) noexcept {
    if (auto wrong = check_pointer("reflections", reflections)) return finish(wrong, error);
    if (auto wrong = check_pointer("texels", texels)) return finish(wrong, error);
    const ReflectionsView& view = reflections->file.view();
    if (level >= view.level_count)
        return finish(not_there("level", level, view.level_count), error);
    *texels = {view.levels[level].data(), view.levels[level].size_bytes(), sizeof(RadianceTexel)};
    return succeed(error);
}

tetralight_status tetralight_reflections_blend(const tetralight_reflections* reflections,
                                               const double* position,
                                               tetralight_reflection_blend* blend,
                                               tetralight_error* error) noexcept {
    if (auto wrong = check_pointer("reflections", reflections)) return finish(wrong, error);
    if (auto wrong = check_position(position)) return finish(wrong, error);
    if (auto wrong = check_pointer("blend", blend)) return finish(wrong, error);
    *blend = std::bit_cast<tetralight_reflection_blend>(
        blend_reflections(reflections->file.view(), glm::make_vec3(position)));
    return succeed(error);
}

tetralight_status tetralight_reflections_sample(const tetralight_reflections* reflections,
                                                const tetralight_reflection_blend* blend,
                                                const double* position, const float* direction,
                                                float roughness, float* radiance,
                                                tetralight_error* error) noexcept {
    if (auto wrong = check_blend(reflections, blend)) return finish(wrong, error);
    if (auto wrong = check_position(position)) return finish(wrong, error);
    if (auto wrong = check_floats("direction", direction, 3)) return finish(wrong, error);
    if (auto wrong = check_unit("roughness", roughness)) return finish(wrong, error);
    if (auto wrong = check_pointer("radiance", radiance)) return finish(wrong, error);
    const glm::vec3 sampled =
        sample_reflections(reflections->file.view(), blend_of(*blend), glm::make_vec3(position),
                           glm::make_vec3(direction), roughness);
    std::memcpy(radiance, &sampled, sizeof sampled);
    return succeed(error);
}

tetralight_status tetralight_reflections_occlusion(const tetralight_reflections* reflections,
                                                   const tetralight_reflection_blend* blend,
                                                   const float* normal, const float* irradiance,
                                                   float roughness, float* occlusion,
                                                   tetralight_error* error) noexcept {
    if (auto wrong = check_blend(reflections, blend)) return finish(wrong, error);
    if (auto wrong = check_floats("normal", normal, 3)) return finish(wrong, error);
    if (auto wrong = check_floats("irradiance", irradiance, 3)) return finish(wrong, error);
    if (auto wrong = check_unit("roughness", roughness)) return finish(wrong, error);
    if (auto wrong = check_pointer("occlusion", occlusion)) return finish(wrong, error);
    const glm::vec3 of_cubes =
        reflection_irradiance(reflections->file.view(), blend_of(*blend), glm::make_vec3(normal));
    *occlusion = reflection_occlusion(glm::make_vec3(irradiance), of_cubes, roughness);
    return succeed(error);
}

tetralight_status tetralight_split_sum(float n_dot_v, float roughness, uint32_t sample_count,
                                       float* scale_and_bias, tetralight_error* error) noexcept {
    if (auto wrong = check_unit("n_dot_v", n_dot_v)) return finish(wrong, error);
    if (auto wrong = check_unit("roughness", roughness)) return finish(wrong, error);
    if (sample_count == 0) {
        return finish({TETRALIGHT_BAD_VALUE, "sample_count is 0"}, error);
    }
    if (auto wrong = check_pointer("scale_and_bias", scale_and_bias)) return finish(wrong, error);
    const glm::vec2 sum = integrate_split_sum(n_dot_v, roughness, sample_count);
    std::memcpy(scale_and_bias, &sum, sizeof sum);
    return succeed(error);
}
