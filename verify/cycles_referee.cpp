// SPDX-License-Identifier: Apache-2.0
#include <tetralight/verify/cycles_referee.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <span>
#include <string_view>
#include <system_error>
#include <utility>

#include <tetralight/bake/image/write_image.h>
#include <tetralight/base/file.h>
#include <tetralight/base/process/process.h>
#include <tetralight/base/str_cat.h>

namespace tetralight {
namespace {

using nlohmann::json;

Error unsupported(const char* field, std::string reason) {
    return {ErrorCode::Unsupported, field, "", std::move(reason)};
}

/// A new folder for temporary files, removed at its end.
class WorkFolder {
  public:
    static Result<WorkFolder> make() {
        std::error_code failed;
        const auto parent = std::filesystem::temp_directory_path(failed);
        std::string path = (failed ? std::string("/tmp") : parent.string()) + "/tetralight.XXXXXX";
        if (::mkdtemp(path.data()) == nullptr) {
            return Error{ErrorCode::Unavailable, "", path,
                         str_cat(path, ": the temporary folder cannot be made")};
        }
        return WorkFolder(std::move(path));
    }

    WorkFolder(WorkFolder&& other) noexcept : path_(std::exchange(other.path_, {})) {}

    WorkFolder& operator=(WorkFolder&&) = delete;

    ~WorkFolder() {
        std::error_code ignored;
        if (!path_.empty()) std::filesystem::remove_all(path_, ignored);
    }

    [[nodiscard]] std::string path(const char* name) const { return path_ + "/" + name; }

    [[nodiscard]] const std::string& path() const { return path_; }

  private:
    explicit WorkFolder(std::string path) : path_(std::move(path)) {}

    std::string path_;
};

template <class Vector>
json numbers(const Vector& v) {
    return {v.x, v.y, v.z};
}

const char* type_name(LightType type) {
    constexpr std::array<const char*, 5> kNames{"directional", "point", "spot", "rectangle",
                                                "disc"};
    return kNames[static_cast<size_t>(type)];
}

json light_json(const Light& light) {
    return {{"type", type_name(light.type)},
            {"intensity", numbers(light.intensity * light.indirect_multiplier)},
            {"position", numbers(light.position)},
            {"direction", numbers(light.direction)},
            {"tangent", numbers(light.tangent)},
            {"range", light.range},
            {"falloff",
             light.falloff == LightFalloff::InverseSquareRange ? "inverse_square_range" : "gltf"},
            {"cos_inner_cone", light.cos_inner_cone},
            {"cos_outer_cone", light.cos_outer_cone},
            {"radius", light.radius},
            {"width", light.width},
            {"height", light.height}};
}

Result<json> lights_json(const Scene& scene, const std::vector<LightMode>& modes) {
    json lights = json::array();
    for (size_t i = 0; i < scene.lights.size(); ++i) {
        const Light& light = scene.lights[i];
        const std::string name = str_cat("light \"", scene.light_names[i], "\": ");
        if (modes[i] == LightMode::Realtime) continue;
        if (modes[i] == LightMode::Baked) {
            return unsupported("lights", name +
                                             "its direct light is baked, which panoramas by "
                                             "Cycles do not see");
        }
        const bool is_area = light.type == LightType::Rectangle || light.type == LightType::Disc;
        if (light.falloff == LightFalloff::Linear || light.falloff == LightFalloff::Legacy ||
            (is_area && light.range > 0.0f)) {
            return unsupported("lights", name + "Cycles does not have its falloff");
        }
        if (light.intensity * light.indirect_multiplier != glm::vec3(0.0f))
            lights.push_back(light_json(light));
    }
    return lights;
}

Result<json> sky_json(const Environment& sky, const WorkFolder& folder) {
    json made{{"radiance", numbers(sky.radiance)}};
    if (sky.image.pixels.empty()) return made;
    const std::string path = folder.path("sky.exr");
    if (auto status = write_exr(path, sky.image); !status) return status.error();
    made["image"] = path;
    made["rotation"] = sky.rotation_radians;
    return made;
}

Status check_job(const Scene& scene, const CyclesJob& job) {
    if (job.bounces == 0) {
        return unsupported("bounces", "Cycles cannot leave out the first reflection (--bounces 0)");
    }
    if (!scene.choice.scene_name.empty() || scene.choice.time_seconds) {
        return unsupported("scene",
                           "Blender imports the default scene of a file without its "
                           "animation; a named scene or a time cannot be compared");
    }
    return Ok{};
}

Result<std::string> job_text(const Scene& scene, const std::vector<LightMode>& modes,
                             const CyclesJob& job, const WorkFolder& folder) {
    const auto lights = lights_json(scene, modes);
    if (!lights) return lights.error();
    const auto sky = sky_json(scene.environment, folder);
    if (!sky) return sky.error();
    json positions = json::array();
    for (const glm::dvec3& position : job.positions) positions.push_back(numbers(position));
    std::error_code failed;
    const auto scene_path = std::filesystem::absolute(job.scene_path, failed);
    const json text{{"scene", failed ? job.scene_path : scene_path.string()},
                    {"positions", positions},
                    {"target_errors", job.target_errors},
                    {"lights", *lights},
                    {"sky", *sky},
                    {"bounces", job.bounces},
                    {"threads", job.thread_count},
                    {"seed", job.seed % (uint64_t{1} << 30)},
                    {"samples", job.sample_count},
                    {"max_samples", job.max_sample_count},
                    {"folder", folder.path()},
                    {"result", folder.path("result.jsonl")}};
    try {
        return text.dump();
    } catch (const json::exception&) {
        return unsupported("scene", "its path is not UTF-8, which Blender needs");
    }
}

Status write_text(const std::string& path, std::string_view text) {
    return write_file(path, std::as_bytes(std::span(text)));
}

size_t count_positions(std::span<const std::byte> output) {
    const std::string_view text(reinterpret_cast<const char*>(output.data()), output.size());
    size_t count = 0;
    for (size_t at = text.find("position "); at != text.npos; at = text.find("position ", at + 1))
        ++count;
    return count;
}

/// How Blender ended.
Result<ProcessResult> run_blender(const CyclesJob& job, const WorkFolder& folder) {
    size_t done = 0;
    const auto result = run_process(
        {.program = job.blender,
         .arguments = {"-b", "--factory-startup", "-noaudio", "--python-exit-code", "1", "--python",
                       folder.path("cycles.py"), "--", folder.path("job.json")},
         .time_limit = job.time_limit,
         .check_output = [&](std::span<const std::byte> output) -> Status {
             done = count_positions(output);
             return Ok{};
         },
         .is_cancelled = [&] { return job.progress && !job.progress(done); }});
    if (!result) {
        return unsupported("blender", str_cat("Blender does not run (\"", job.blender,
                                              "\"); install it (Debian package blender), or "
                                              "compare with the path tracer"));
    }
    if (result->end == ProcessResult::End::Cancelled)
        return Error{ErrorCode::Cancelled, "cancelled"};
    if (result->end == ProcessResult::End::TimedOut) {
        return unsupported("time_limit", "Cycles was not done within the time limit");
    }
    return *result;
}

/// Nine RGB triples.
RadianceSh radiance_from_json(const json& rows) {
    RadianceSh radiance;
    for (size_t i = 0; i < radiance.coefficients.size(); ++i) {
        const json& row = rows.at(i);
        radiance.coefficients[i] = {row.at(0).get<float>(), row.at(1).get<float>(),
                                    row.at(2).get<float>()};
    }
    return radiance;
}

void add_line(CyclesResult& result, std::string& error, const json& line) {
    if (line.contains("error")) {
        error = line["error"].get<std::string>();
    } else if (line.contains("version")) {
        result.referee = "Cycles " + line["version"].get<std::string>();
    } else {
        std::vector<RadianceSh> rounds;
        for (const json& round : line.at("coefficients"))
            rounds.push_back(radiance_from_json(round));
        result.lights.push_back(mean_of_rounds(rounds, line.at("samples").get<uint64_t>()));
    }
}

Result<CyclesResult> read_result(const CyclesJob& job, const WorkFolder& folder,
                                 const ProcessResult& ended) {
    CyclesResult result;
    std::string error = ended.succeeded() ? "" : "it " + ended.failure();
    if (const auto bytes = read_file(folder.path("result.jsonl"))) {
        std::string_view text(reinterpret_cast<const char*>(bytes->data()), bytes->size());
        try {
            while (!text.empty()) {
                const size_t end = std::min(text.find('\n'), text.size());
                add_line(result, error, json::parse(text.substr(0, end)));
                text.remove_prefix(std::min(end + 1, text.size()));
            }
        } catch (const json::exception&) {
            error = "its result is incomplete";
        }
    }
    if (error.empty() && result.lights.size() != job.positions.size()) {
        error = str_cat("it rendered ", result.lights.size(), " of ", job.positions.size(),
                        " positions");
    }
    if (!error.empty()) return unsupported("referee", "Blender: " + error);
    return result;
}

}  // namespace

TracedLight mean_of_rounds(const std::vector<RadianceSh>& rounds, uint64_t sample_count) {
    const auto count = static_cast<double>(rounds.size());
    RadianceShSum sum;
    std::vector<glm::dvec3> lights;
    glm::dvec3 total(0.0), squares(0.0);
    for (const RadianceSh& round : rounds) {
        for (size_t i = 0; i < sum.coefficients.size(); ++i)
            sum.coefficients[i] += glm::dvec3(round.coefficients[i]);
        lights.push_back(mean_over_normals(irradiance_from_radiance(round)));
        total += lights.back();
    }
    TracedLight light;
    light.irradiance = irradiance_from_radiance(radiance_from_sum(sum, 1.0 / count));
    light.mean = total / count;
    for (const glm::dvec3& one : lights) squares += (one - light.mean) * (one - light.mean);
    light.error = glm::sqrt(squares / (count * (count - 1.0)));
    light.sample_count = sample_count;
    return light;
}

Result<CyclesResult> trace_by_cycles(const Scene& scene, const std::vector<LightMode>& light_modes,
                                     const CyclesJob& job) {
    if (auto status = check_job(scene, job); !status) return status.error();
    const auto folder = WorkFolder::make();
    if (!folder) return folder.error();
    const auto text = job_text(scene, light_modes, job, *folder);
    if (!text) return text.error();
    if (auto status = write_text(folder->path("job.json"), *text); !status) return status.error();
    if (auto status = write_text(folder->path("cycles.py"), kCyclesScript); !status)
        return status.error();
    const auto ended = run_blender(job, *folder);
    if (!ended) return ended.error();
    return read_result(job, *folder, *ended);
}

}  // namespace tetralight
