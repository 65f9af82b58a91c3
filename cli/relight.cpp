// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/relight.h>

#include <algorithm>
#include <charconv>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/trigonometric.hpp>
#include <limits>
#include <string_view>

#include <tetralight/bake/project_environment.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/cli/common.h>
#include <tetralight/cli/paths.h>
#include <tetralight/cli/sky_options.h>
#include <tetralight/pipeline/partial_bake.h>
#include <tetralight/probes/blend_volumes.h>
#include <tetralight/probes/probe_file.h>
#include <tetralight/probes/recombine.h>

namespace tetralight::cli {
namespace {

/// "lamp=0.5", blanks before it allowed; nothing: it is written otherwise. Weights that no float
/// holds become infinity.
std::optional<LayerWeight> parse_weight(std::string_view text) {
    text.remove_prefix(std::min(text.find_first_not_of(' '), text.size()));
    const size_t equals = text.rfind('=');
    if (equals == std::string::npos || equals == 0) return std::nullopt;
    const std::string_view number = text.substr(equals + 1);
    double weight = 0.0;
    const auto [next, error] = std::from_chars(number.begin(), number.end(), weight);
    if (error == std::errc::invalid_argument || next != number.end()) return std::nullopt;
    if (error == std::errc::result_out_of_range) weight = std::numeric_limits<double>::infinity();
    return LayerWeight{text.substr(0, equals), static_cast<float>(weight)};
}

CLI::Validator weight_check() {
    const auto check = [](std::string& text) -> std::string {
        return parse_weight(text) ? "" : "\"" + text + "\" is not of the form LAYER=WEIGHT";
    };
    return {check, ""};
}

CLI::Validator direction_check() {
    const auto check = [](const std::string& direction) -> std::string {
        const auto parsed = parse_vec3(direction);
        if (!parsed || glm::length(*parsed) > 0.0) return "";
        return "\"" + direction + "\" is not a direction";
    };
    return {check, ""};
}

struct Relight {
    std::string volume_path;
    std::string output;
    std::vector<std::string> weights;
    SkyOptions sky;
    glm::dvec3 sun_direction{0.0};
    glm::dvec3 sun_irradiance{-1.0};
    std::string blend_path;
    double blend_share = 0.5;
    CommonOptions common;

    void add_to(CLI::App& command) {
        add_path(command, "VOLUME", volume_path, "Probe volume baked with --layers (.probes)")
            ->required();
        add_output(command, output, ".probes", "Probe volume to write");
        command
            .add_option("--weights", weights,
                        "New weights of layers, 1 = as baked: lamp=0,neon=2; others stay as they "
                        "are")
            ->delimiter(',')
            ->allow_extra_args(false)
            ->check(weight_check())
            ->type_name("LAYER=W,...");
        sky.add_to(command, "that of the bake (needs layer \"transfer\")");
        auto* direction = add_vec3(command, "--sun-direction", sun_direction,
                                   "Move the sun, so that it shines in this direction (needs "
                                   "layers \"sun\" and \"transfer\")");
        direction->check(direction_check());
        add_vec3(command, "--sun-irradiance", sun_irradiance,
                 "Its irradiance on a surface that faces it (default: as baked)")
            ->needs(direction)
            ->check(numbers_in(0.0, kMaxRadiance).description(""))
            ->type_name("R,G,B");
        auto* blend_option =
            add_path(command, "--blend", blend_path, "Blend with this volume of the same probes");
        command.add_option("--blend-share", blend_share, "How much of the light is that volume's")
            ->check(numbers_in(0.0, 1.0))
            ->needs(blend_option)
            ->capture_default_str();
        common.add_to(command);
    }

    Status run() {
        if (auto status = check_output(output, {volume_path, sky.sky, blend_path}); !status) {
            return status;
        }
        const auto file = open_probe_file(volume_path);
        if (!file) return file.error();
        if (is_part(*file)) {
            return Error{"is a part of a bake; merge its parts first"}.in(volume_path);
        }
        ProbeVolume volume = copy_volume(file->view());
        if (auto status = change(volume); !status) return status.error().in(volume_path);
        if (!blend_path.empty()) {
            if (auto status = blend_with(volume); !status) return status;
        }
        volume.metadata = metadata(made_with(volume.view()));
        if (auto status = write_probe_file(output, volume.view()); !status) return status;
        report(volume);
        return Ok{};
    }

    /// With what was changed, in words that repeat it; weights are recorded with their layers.
    [[nodiscard]] std::string metadata(Json recipe) const {
        if (recipe.is_null()) recipe = Json::object();
        std::string relit = recipe.value("relit", "");
        const auto add = [&](const char* option, const std::string& value) {
            relit += str_cat(relit.empty() ? "" : " ", option, " ", value);
        };
        const auto vector = [](const glm::dvec3& v) { return str_cat(v.x, ",", v.y, ",", v.z); };
        if (!sky.sky.empty()) add("--sky", sky.sky);
        if (sky.intensity != 1.0) add("--sky-intensity", str_cat(sky.intensity));
        if (sky.rotation_degrees != 0.0) add("--sky-rotation", str_cat(sky.rotation_degrees));
        if (sun_direction != glm::dvec3(0.0)) add("--sun-direction", vector(sun_direction));
        if (sun_irradiance.x >= 0.0) add("--sun-irradiance", vector(sun_irradiance));
        if (!blend_path.empty()) {
            add("--blend", blend_path);
            add("--blend-share", str_cat(blend_share));
        }
        if (!relit.empty()) recipe["relit"] = relit;
        return dump(recipe);
    }

    [[nodiscard]] bool changes_sky() const {
        return !sky.sky.empty() || sky.intensity != 1.0 || sky.rotation_degrees != 0.0;
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
        for (const std::string& text : weights) changes.push_back(*parse_weight(text));
        const auto all = layer_weights(volume.view(), changes);
        return all ? recombine(volume, *all) : Status(all.error());
    }

    /// Another one, or the volume's own, turned and dimmed.
    [[nodiscard]] Status change_sky(ProbeVolume& volume) const {
        if (!sky.sky.empty()) {
            Environment environment;
            std::vector<std::string> warnings;
            if (auto status = sky.apply(volume_path, environment, warnings); !status) return status;
            common.warn(warnings);
            return relight_sky(volume, project_sky(environment, common.thread_count));
        }
        DistantLight turned;
        if (!volume.sky.empty()) {
            const auto angle = glm::radians(static_cast<float>(sky.rotation_degrees));
            turned = rotate(volume.sky[0],
                            glm::mat3(glm::rotate(glm::mat4(1.0f), angle, glm::vec3(0, 1, 0))));
            turned *= static_cast<float>(sky.intensity);
        }
        return relight_sky(volume, turned);
    }

    [[nodiscard]] Status move_sun(ProbeVolume& volume) const {
        const auto sun = movable_sun(volume.view());
        if (!sun) return sun.error();
        const bool is_as_baked = sun_irradiance.x < 0.0;
        return relight_sun(volume, glm::vec3(glm::normalize(sun_direction)),
                           is_as_baked ? volume.lights[*sun].intensity : glm::vec3(sun_irradiance));
    }

    [[nodiscard]] Status blend_with(ProbeVolume& volume) const {
        const auto file = open_probe_file(blend_path);
        if (!file) return file.error();
        auto blended = blend_volumes(volume.view(), file->view(), static_cast<float>(blend_share));
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
        common.report(output,
                      {{"output", output}, {"probes", volume.positions.size()}, {"layers", layers}},
                      str_cat(output, ": ", counted(volume.positions.size(), "probe"),
                              line.empty() ? "" : ", layers " + line));
    }
};

}  // namespace

void add_relight(CLI::App& app, Run& run) {
    add_command<Relight>(app, run, "relight", "Change the light of a volume without baking again",
                         "tetralight relight court.probes --weights lamp=0,neon=2 --sky dusk.exr "
                         "-o night.probes");
}

}  // namespace tetralight::cli
