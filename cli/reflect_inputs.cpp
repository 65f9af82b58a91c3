// SPDX-License-Identifier: Apache-2.0
#include <tetralight/cli/reflect_inputs.h>

#include <algorithm>
#include <glm/common.hpp>

#include <tetralight/bake/scene/read_gltf.h>
#include <tetralight/bake/scene/reflection_places_json.h>
#include <tetralight/base/shown_path.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/pipeline/reflection_settings.h>

namespace tetralight::cli {
namespace {

BakeReflectionsSettings reflection_settings(const Values& values) {
    BakeReflectionsSettings settings;
    for_each_reflection_setting(settings, [&](const char* name, auto& member, Recorded) {
        read_if_any(values, name, member);
    });
    constexpr uint32_t kRaysToLightmaps = 16;
    if (values.is_given("lightmaps") && !values.is_given("samples"))
        settings.bake.sample_count = kRaysToLightmaps;
    settings.has_sky = !values.flag("no_sky");
    const uint32_t size = settings.cube_size;
    if ((size & (size - 1)) != 0)
        refuse(values, "cube_size", str_cat(size, " is not a power of two"));
    return settings;
}

/// The place of --box; none if it was not given.
std::vector<ReflectionPlace> place_of_box(const Values& values) {
    if (!values.is_given("box")) return {};
    const std::vector<double> box = values.numbers("box");
    const glm::dvec3 min(box[0], box[1], box[2]), max(box[3], box[4], box[5]);
    for (int axis = 0; axis < 3; ++axis) {
        if (min[axis] < max[axis]) continue;
        refuse(values, "box",
               str_cat("the minimum ", min[axis], " is not below the maximum ", max[axis]));
    }
    ReflectionPlace place;
    const glm::dvec3 center = 0.5 * (min + max);
    place.name = "box";
    place.position = values.is_given("position") ? vec3(values, "position") : center;
    place.box_center = glm::vec3(center - place.position);
    place.half_size = glm::vec3(0.5 * (max - min));
    place.blend_distance = static_cast<float>(values.number("blend_distance"));
    return {place};
}

}  // namespace

ReflectInputs::ReflectInputs(const Values& values)
    : scene_options(values),
      settings(reflection_settings(values)),
      names(values.texts("probe")),
      places_path(values.text("places")),
      lightmaps_path(values.text("lightmaps")),
      given_places(place_of_box(values)) {}

std::vector<std::string> ReflectInputs::paths() const {
    std::vector<std::string> paths = scene_options.inputs();
    paths.insert(paths.end(), {places_path, lightmaps_path});
    return paths;
}

Result<std::vector<ReflectionPlace>> ReflectInputs::places(const Scene& scene) const {
    if (!given_places.empty()) return given_places;
    const std::string& path = places_path.empty() ? scene_options.path : places_path;
    const auto all = places_path.empty() ? Result(scene.reflection_places) : read_places();
    if (!all || names.empty()) return all;
    std::vector<ReflectionPlace> chosen;
    for (const std::string& name : names) {
        const auto place = std::ranges::find(*all, name, &ReflectionPlace::name);
        if (place == all->end()) {
            return Error{
                ErrorCode::NotFound, "probe", name,
                str_cat(shown_path(path), ": no reflection probe \"", name, "\" is there")};
        }
        chosen.push_back(*place);
    }
    return chosen;
}

Result<std::vector<ReflectionPlace>> ReflectInputs::read_places() const {
    if (places_path.ends_with(".json")) return read_reflection_places_json(places_path);
    auto scene = read_gltf(places_path);
    if (!scene) return scene.error();
    return std::move(scene->reflection_places);
}

Error ReflectInputs::in_file(const Error& error) const {
    if (error.code != ErrorCode::InvalidArgument && error.code != ErrorCode::NotFound) return error;
    const bool is_of_lightmaps = error.field == "lightmaps" || error.field == "scene";
    const bool is_of_places = error.field == "probes" || error.field == "name";
    const std::string& path = is_of_lightmaps && !lightmaps_path.empty() ? lightmaps_path
                              : is_of_places && !places_path.empty()     ? places_path
                                                                         : scene_options.path;
    return error.in(shown_path(path));
}

}  // namespace tetralight::cli
