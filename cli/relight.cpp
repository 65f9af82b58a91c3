// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/relight.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/trigonometric.hpp>
#include <string_view>

#include <tetralight/bake/project_environment.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/cli/common.h>
#include <tetralight/cli/layer_report.h>
#include <tetralight/cli/lightmap_files.h>
#include <tetralight/cli/paths.h>
#include <tetralight/cli/reflection_files.h>
#include <tetralight/cli/sky_options.h>
#include <tetralight/pipeline/partial_bake.h>
#include <tetralight/probes/blend_volumes.h>
#include <tetralight/probes/layer_noise.h>
#include <tetralight/probes/probe_file.h>
#include <tetralight/probes/recombine.h>

namespace tetralight::cli {
namespace {

struct Relight {
    std::string volume_path;
    std::string output;
    std::vector<std::pair<std::string, float>> weights;
    SkyOptions sky;
    glm::dvec3 sun_direction{0.0};
    std::optional<glm::dvec3> sun_irradiance;
    std::string blend_path;
    double blend_fraction = 0.5;
    CommonOptions common;

    explicit Relight(const Values& values)
        : volume_path(values.text("volume")),
          output(values.text("output")),
          sky(values),
          sun_direction(vec3(values, "sun_direction")),
          blend_path(values.text("blend")),
          blend_fraction(values.number("blend_share")),
          common(values) {
        if (const auto* all = values.find("weights")) {
            for (const auto& [layer, weight] : all->items()) {
                weights.emplace_back(layer, static_cast<float>(weight.get<double>()));
            }
        }
        if (values.is_given("sun_irradiance")) sun_irradiance = vec3(values, "sun_irradiance");
    }

    Status run() {
        if (auto status = check_output(output, {volume_path, sky.path, blend_path}); !status) {
            return status;
        }
        const bool has_reflections = is_reflection_file(volume_path);
        const bool has_lightmaps = is_lightmap_file(volume_path);
        const char* contents = has_reflections ? "reflection probes"
                               : has_lightmaps ? "lightmaps"
                                               : "probes";
        if (auto status = check_output_kind(volume_path, output, contents); !status) return status;
        if (has_reflections) return run_reflections();
        if (has_lightmaps) return run_lightmaps();
        const auto file = open_probe_file(volume_path);
        if (!file) return file.error();
        if (is_part(*file)) {
            return Error{ErrorCode::InvalidArgument, "volume", volume_path,
                         volume_path + ": is a part of a bake; merge its parts first"};
        }
        ProbeVolume volume = copy_volume(file->view());
        if (auto status = change(volume); !status) {
            Error error = status.error().in(volume_path);
            if (error.field.empty()) error.field = "volume";
            return error;
        }
        if (!blend_path.empty()) {
            if (auto status = blend_with(volume); !status) return status;
        }
        volume.metadata = metadata(made_with(volume.view()));
        if (auto status = write_probe_file(output, volume.view()); !status) return status;
        report(volume);
        return Ok{};
    }

    [[nodiscard]] Status run_lightmaps() const {
        if (changes_sky() || sun_direction != glm::dvec3(0.0)) {
            return Error{ErrorCode::InvalidArgument, "volume", volume_path,
                         volume_path +
                             ": contains lightmaps, whose sky and sun change by the weights of "
                             "their layers alone"};
        }
        return relight_lightmap_file(
            volume_path, output, {weights, blend_path, static_cast<float>(blend_fraction)}, common);
    }

    [[nodiscard]] Status run_reflections() const {
        if (changes_sky() || sun_direction != glm::dvec3(0.0) || !blend_path.empty()) {
            return Error{ErrorCode::InvalidArgument, "volume", volume_path,
                         volume_path +
                             ": contains reflection probes, whose light changes by the weights of "
                             "their layers alone"};
        }
        return relight_reflection_file(volume_path, output, weights, common);
    }

    /// With the options that repeat the change; weights are recorded with their layers.
    [[nodiscard]] std::string metadata(Json recipe) const {
        if (recipe.is_null()) recipe = Json::object();
        std::string relit = recipe.value("relit", "");
        const auto add = [&](const char* option, const std::string& value) {
            relit += str_cat(relit.empty() ? "" : " ", option, " ", value);
        };
        const auto vector = [](const glm::dvec3& v) { return str_cat(v.x, ",", v.y, ",", v.z); };
        const auto color = [&](const glm::dvec3& c) {
            return c == glm::dvec3(c.x) ? str_cat(c.x) : vector(c);
        };
        if (sky.constant) add("--sky", color(*sky.constant));
        if (!sky.path.empty()) add("--sky", sky.path);
        if (sky.intensity != 1.0) add("--sky-intensity", str_cat(sky.intensity));
        if (sky.rotation_degrees != 0.0) add("--sky-rotation", str_cat(sky.rotation_degrees));
        if (sun_direction != glm::dvec3(0.0)) add("--sun-direction", vector(sun_direction));
        if (sun_irradiance) add("--sun-irradiance", vector(*sun_irradiance));
        if (!blend_path.empty()) {
            add("--blend", blend_path);
            add("--blend-share", str_cat(blend_fraction));
        }
        if (!relit.empty()) recipe["relit"] = relit;
        return dump(recipe);
    }

    [[nodiscard]] bool changes_sky() const {
        return sky.replaces_sky() || sky.intensity != 1.0 || sky.rotation_degrees != 0.0;
    }

    [[nodiscard]] Status change(ProbeVolume& volume) const {
        if (changes_sky()) {
            if (auto status = change_sky(volume); !status) return status;
        }
        if (sun_direction != glm::dvec3(0.0)) {
            if (auto status = move_sun(volume); !status) return status;
        }
        if (weights.empty()) return Ok{};
        std::vector<LayerWeight> changes;
        for (const auto& [layer, weight] : weights) changes.push_back({layer, weight});
        const auto all = layer_weights(volume.view(), changes);
        return all ? recombine(volume, *all) : Status(all.error());
    }

    /// Replaces the sky, or rotates and scales that of the volume.
    [[nodiscard]] Status change_sky(ProbeVolume& volume) const {
        if (sky.replaces_sky()) {
            Environment environment;
            std::vector<std::string> warnings;
            if (auto status = sky.apply(volume_path, environment, warnings); !status) return status;
            common.warn(warnings);
            return relight_sky(volume, project_sky(environment, common.thread_count));
        }
        DistantLight rotated;
        if (!volume.sky.empty()) {
            const auto angle = glm::radians(static_cast<float>(sky.rotation_degrees));
            rotated = rotate(volume.sky[0],
                             glm::mat3(glm::rotate(glm::mat4(1.0f), angle, glm::vec3(0, 1, 0))));
            rotated *= static_cast<float>(sky.intensity);
        }
        return relight_sky(volume, rotated);
    }

    [[nodiscard]] Status move_sun(ProbeVolume& volume) const {
        const auto sun = movable_sun(volume.view());
        if (!sun) return sun.error();
        return relight_sun(
            volume, glm::vec3(glm::normalize(sun_direction)),
            sun_irradiance ? glm::vec3(*sun_irradiance) : volume.lights[*sun].intensity);
    }

    [[nodiscard]] Status blend_with(ProbeVolume& volume) const {
        const auto file = open_probe_file(blend_path);
        if (!file) return file.error();
        auto blended =
            blend_volumes(volume.view(), file->view(), static_cast<float>(blend_fraction));
        if (!blended) return blended.error().in(blend_path);
        volume = std::move(*blended);
        return Ok{};
    }

    void report(const ProbeVolume& volume) const {
        const auto names = split_names(volume.layer_names);
        Json layers = Json::array();
        std::string line;
        for (size_t i = 0; i < names.size() && i < volume.layers.size(); ++i) {
            layers.push_back({{"name", names[i]}, {"weight", volume.layers[i].weight}});
            line += str_cat(line.empty() ? "" : ", ", printable(std::string(names[i])), " ",
                            volume.layers[i].weight);
        }
        const auto dilated = std::ranges::count_if(
            volume.health, [](const ProbeHealth& health) { return health.is_dilated != 0; });
        common.report(output,
                      {{"output", output},
                       {"probes", volume.positions.size()},
                       {"dilated", dilated},
                       {"standard_error", to_json(relit_noise(volume.view()))},
                       {"layers", layers}},
                      str_cat(output, ": ", counted(volume.positions.size(), "probe"),
                              line.empty() ? "" : ", layers " + line));
    }
};

}  // namespace

Status run_relight(const Values& values) {
    return Relight(values).run();
}

}  // namespace tetralight::cli
