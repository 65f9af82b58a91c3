// SPDX-License-Identifier: Apache-2.0
#include <tetralight/cli/explain_scene.h>

#include <algorithm>
#include <optional>

#include <tetralight/bake/rays/memory_estimate.h>
#include <tetralight/bake/scene/scene_bounds.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/cli/commands.h>
#include <tetralight/cli/scene_parts_report.h>
#include <tetralight/cli/scene_reading.h>
#include <tetralight/cli/table.h>
#include <tetralight/cli/walls_report.h>

namespace tetralight::cli {
namespace {

/// What a process has of code, tables and threads: to read a scene, and to bake it.
constexpr uint64_t kReadingProgramBytes = 45'000'000, kBakingProgramBytes = 52'000'000;

/// What a scene contains, in numbers.
struct SceneFacts {
    uint64_t triangle_count = 0;
    /// Of all instances; empty if there are none.
    std::optional<WorldBox> bounds;
    /// The most memory that a process has that reads it, and that bakes it without probes.
    uint64_t reading_bytes = 0;
    uint64_t bake_bytes = 0;
};

SceneFacts scene_facts(const Scene& scene) {
    SceneFacts facts;
    for (const MeshInstance& instance : scene.instances)
        facts.triangle_count += scene.meshes[instance.mesh].indices.size() / 3;
    facts.bounds = scene_bounds(scene, [](const MeshInstance&) { return true; });
    const uint64_t bake = scene.memory.scene_bytes() + estimate_bake_memory(scene, 0).total_bytes();
    facts.reading_bytes = kReadingProgramBytes + scene.memory.peak_bytes();
    facts.bake_bytes = std::max(facts.reading_bytes, kBakingProgramBytes + bake);
    return facts;
}

Json scene_json(const std::string& path, const Scene& scene, const SceneFacts& facts) {
    const Json bounds = facts.bounds ? Json{{"min", to_json(facts.bounds->min)},
                                            {"max", to_json(facts.bounds->max)}}
                                     : Json();
    return {{"scene", path},
            {"parts", parts_json(scene.parts)},
            {"bounds", bounds},
            {"triangles", facts.triangle_count},
            {"reading_memory_bytes", facts.reading_bytes},
            {"memory_bytes", facts.bake_bytes}};
}

std::string bytes_text(uint64_t bytes) {
    return magnitude(static_cast<double>(bytes)) + "B";
}

std::string scene_text(const std::string& path, const Scene& scene, const SceneFacts& facts) {
    const std::string bounds = facts.bounds ? str_cat(position_text(facts.bounds->min), " to ",
                                                      position_text(facts.bounds->max))
                                            : "none (no objects)";
    const std::string memory = str_cat(bytes_text(facts.reading_bytes), " to read it, ",
                                       bytes_text(facts.bake_bytes), " to bake it without probes");
    std::string text = str_cat(
        printable(path), "\n",
        aligned(
            {{"triangles", grouped(facts.triangle_count)}, {"bounds", bounds}, {"memory", memory}},
            "ll"),
        parts_text(scene.parts));
    text.pop_back();
    return text;
}

}  // namespace

Status show_scene(const std::string& path, const SceneReading& reading,
                  const CommonOptions& common) {
    const auto scene = read_scene(path, reading);
    if (!scene) return scene.error();
    common.warn(warnings_beside_parts(*scene));
    const SceneFacts facts = scene_facts(*scene);
    common.print(scene_json(path, *scene, facts), scene_text(path, *scene, facts));
    return Ok{};
}

Status run_explain(const Values& values) {
    return show_scene(values.text("scene"), scene_reading(values, NormalMaps::Read),
                      CommonOptions(values));
}

}  // namespace tetralight::cli
