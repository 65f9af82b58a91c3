// SPDX-License-Identifier: Apache-2.0
#include <cstring>
#include <glm/gtc/type_ptr.hpp>
#include <iterator>

#include <tetralight/lightmap/lightmap_file.h>
#include <tetralight/lightmap/sample_lightmap.h>
#include <tetralight/runtime/detail/c_arrays.h>
#include <tetralight/runtime/detail/c_open.h>
#include <tetralight/runtime/detail/c_views.h>
#include <tetralight/runtime/tetralight.h>

struct tetralight_lightmaps {
    tetralight::LightmapFile file;
};

namespace {

using namespace tetralight;
using detail::c_view;
using detail::CallError;
using detail::check_floats;
using detail::check_pointer;
using detail::finish;
using detail::succeed;

static_assert(TETRALIGHT_NO_PAGE == kNoIndex);

/// An array of lightmaps by its name.
struct LightmapArray {
    const char* name;
    tetralight_const_array (*view)(const LightmapsView& lightmaps);
};

/// In the order of tetralight_lightmap_array.
constexpr LightmapArray kLightmapArrays[] = {
    {"irradiance", [](const LightmapsView& v) { return c_view(v.irradiance); }},
    {"light for normal maps", [](const LightmapsView& v) { return c_view(v.light); }},
    {"validity", [](const LightmapsView& v) { return c_view(v.validity); }},
    {"standard errors", [](const LightmapsView& v) { return c_view(v.error); }},
    {"a shadow mask", [](const LightmapsView& v) { return c_view(v.shadow_mask); }},
    {"ambient occlusion", [](const LightmapsView& v) { return c_view(v.ambient_occlusion); }},
    {"instance names", [](const LightmapsView& v) { return c_view(v.instance_names); }},
    {"metadata", [](const LightmapsView& v) { return c_view(v.metadata); }},
};

static_assert(std::size(kLightmapArrays) == TETRALIGHT_LIGHTMAP_METADATA + 1);

/// What is wrong with the place of a sample.
CallError check_place(const tetralight_lightmaps* lightmaps, uint32_t page, const float* uv_page) {
    if (auto wrong = check_pointer("lightmaps", lightmaps)) return wrong;
    if (auto wrong = check_floats("uv_page", uv_page, 2)) return wrong;
    const uint32_t page_count = lightmaps->file.view().info.page_count;
    if (page < page_count) return {};
    return {TETRALIGHT_NOT_THERE, str_cat("page ", page, " is not there; there are ", page_count)};
}

}  // namespace

tetralight_status tetralight_lightmaps_open(const char* path, tetralight_lightmaps** lightmaps,
                                            tetralight_error* error) noexcept {
    return detail::open_path(open_lightmap_file, path, "lightmaps", lightmaps, error);
}

tetralight_status tetralight_lightmaps_open_memory(const void* bytes, size_t size,
                                                   tetralight_lightmaps** lightmaps,
                                                   tetralight_error* error) noexcept {
    return detail::open_bytes(open_lightmap_memory, bytes, size, "lightmaps", lightmaps, error);
}

void tetralight_lightmaps_close(tetralight_lightmaps* lightmaps) noexcept {
    delete lightmaps;
}

tetralight_status tetralight_lightmaps_get_info(const tetralight_lightmaps* lightmaps,
                                                tetralight_lightmaps_info* info,
                                                tetralight_error* error) noexcept {
    if (auto wrong = check_pointer("lightmaps", lightmaps)) return finish(wrong, error);
    if (auto wrong = check_pointer("info", info)) return finish(wrong, error);
    const LightmapsView& view = lightmaps->file.view();
    *info = {view.info.page_size,
             view.info.page_count,
             static_cast<uint32_t>(view.rectangles.size()),
             view.light.empty() ? 0u : 1u,
             view.info.scale,
             static_cast<uint32_t>(view.info.mixed_lighting),
             view.ambient_occlusion.empty() ? 0u : 1u};
    return succeed(error);
}

tetralight_status tetralight_lightmaps_rectangle(const tetralight_lightmaps* lightmaps,
                                                 uint32_t instance,
                                                 tetralight_lightmap_place* place,
                                                 tetralight_error* error) noexcept {
    if (auto wrong = check_pointer("lightmaps", lightmaps)) return finish(wrong, error);
    if (auto wrong = check_pointer("place", place)) return finish(wrong, error);
    const auto rectangles = lightmaps->file.view().rectangles;
    if (instance >= rectangles.size()) {
        return finish({TETRALIGHT_NOT_THERE, str_cat("instance ", instance, " is not there; there ",
                                                     "are ", rectangles.size())},
                      error);
    }
    const LightmapRectangle& rectangle = rectangles[instance];
    *place = {{rectangle.scale.x, rectangle.scale.y},
              {rectangle.offset.x, rectangle.offset.y},
              rectangle.page};
    return succeed(error);
}

tetralight_status tetralight_lightmaps_get_array(const tetralight_lightmaps* lightmaps,
                                                 uint32_t which, tetralight_const_array* array,
                                                 tetralight_error* error) noexcept {
    if (auto wrong = check_pointer("lightmaps", lightmaps)) return finish(wrong, error);
    if (auto wrong = check_pointer("array", array)) return finish(wrong, error);
    if (which >= std::size(kLightmapArrays)) {
        return finish({TETRALIGHT_BAD_VALUE, str_cat("which is out of range: ", which)}, error);
    }
    const LightmapArray& wanted = kLightmapArrays[which];
    const tetralight_const_array view = wanted.view(lightmaps->file.view());
    if (!view.data) {
        return finish({TETRALIGHT_NOT_THERE, str_cat("the lightmaps do not hold ", wanted.name)},
                      error);
    }
    *array = view;
    return succeed(error);
}

tetralight_status tetralight_lightmaps_sample(const tetralight_lightmaps* lightmaps, uint32_t page,
                                              const float* uv_page, const float* base_normal,
                                              const float* normal, float* irradiance,
                                              tetralight_error* error) noexcept {
    if (auto wrong = check_place(lightmaps, page, uv_page)) return finish(wrong, error);
    if (normal) {
        if (auto wrong = check_floats("normal", normal, 3)) return finish(wrong, error);
        if (auto wrong = check_floats("base_normal", base_normal, 3)) return finish(wrong, error);
    }
    if (auto wrong = check_pointer("irradiance", irradiance)) return finish(wrong, error);
    const LightmapsView& view = lightmaps->file.view();
    const glm::vec2 uv = glm::make_vec2(uv_page);
    const glm::vec3 sampled =
        normal
            ? sample_lightmap(view, page, uv, {glm::make_vec3(base_normal), glm::make_vec3(normal)})
            : sample_irradiance(view, page, uv);
    std::memcpy(irradiance, &sampled, sizeof sampled);
    return succeed(error);
}

tetralight_status tetralight_lightmaps_shadow_mask(const tetralight_lightmaps* lightmaps,
                                                   uint32_t page, const float* uv_page,
                                                   float* visible,
                                                   tetralight_error* error) noexcept {
    if (auto wrong = check_place(lightmaps, page, uv_page)) return finish(wrong, error);
    if (auto wrong = check_pointer("visible", visible)) return finish(wrong, error);
    const glm::vec4 sampled =
        sample_shadow_mask(lightmaps->file.view(), page, glm::make_vec2(uv_page));
    std::memcpy(visible, &sampled, sizeof sampled);
    return succeed(error);
}

tetralight_status tetralight_lightmaps_ambient_occlusion(const tetralight_lightmaps* lightmaps,
                                                         uint32_t page, const float* uv_page,
                                                         float* open,
                                                         tetralight_error* error) noexcept {
    if (auto wrong = check_place(lightmaps, page, uv_page)) return finish(wrong, error);
    if (auto wrong = check_pointer("open", open)) return finish(wrong, error);
    *open = sample_ambient_occlusion(lightmaps->file.view(), page, glm::make_vec2(uv_page));
    return succeed(error);
}
