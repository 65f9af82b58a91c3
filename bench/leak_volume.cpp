// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bench/leak_volume.h>

#include <cmath>
#include <utility>

#include <tetralight/bake/blocked_fraction.h>
#include <tetralight/bake/placement/light_difference.h>
#include <tetralight/base/error_text.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/bench/harness.h>
#include <tetralight/render/with_walls.h>

namespace tetralight::bench {
namespace {

BakedVolume bake(const Scene& scene, std::span<const ProbeGroup> groups, uint32_t sample_count) {
    BakeVolumeSettings settings;
    settings.bake.sample_count = sample_count;
    auto baked = bake_volume(scene, groups, settings);
    require(bool(baked), baked ? "" : error_text(baked.error()));
    require(!baked->volume.visibility_blocks.empty(), "the volume knows walls");
    return std::move(*baked);
}

TraceScene trace(const Scene& scene) {
    auto traced = TraceScene::make_static(scene);
    require(bool(traced), traced ? "" : error_text(traced.error()));
    return std::move(*traced);
}

/// Batches sum in another order than single queries.
bool is_same(const IrradianceSh& a, const IrradianceSh& b) {
    const double difference = mean_square(a + -1.0f * b);
    return difference <= 1e-8 * mean_square(b) + 1e-30;
}

}  // namespace

LeakVolume::LeakVolume(const Scene& scene, std::span<const ProbeGroup> groups,
                       uint32_t sample_count)
    : baked_(bake(scene, groups, sample_count)), traced_(trace(scene)) {}

LeakAnswers LeakVolume::answers(std::span<const glm::vec3> positions) const {
    LeakAnswers answers{
        batch(positions, Walls::Ignore), batch(positions, Walls::HideProbes), {}, {}};
    for (const glm::vec3& position : positions) answer_by_rays(position, answers);
    return answers;
}

std::vector<IrradianceSh> LeakVolume::batch(std::span<const glm::vec3> positions,
                                            Walls walls) const {
    std::vector<IrradianceSh> light(positions.size());
    require(
        bool(interpolate(view(), {.positions = positions, .irradiance = light, .walls = walls})),
        "batch");
    const ProbeVolumeView known = with_walls(view(), walls);
    for (size_t i = 0; i < positions.size(); i += 16) {
        const CellLocation location = locate(known, positions[i]);
        require(is_same(light[i], interpolate(known, location).irradiance),
                "a batch answers as single queries do");
    }
    return light;
}

void LeakVolume::answer_by_rays(const glm::vec3& position, LeakAnswers& answers) const {
    const ProbeVolumeView volume = view();
    CellLocation location = locate(volume, position);
    glm::vec4 seen(0.0f);
    float sum = 0.0f;
    for (int i = 0; i < 4; ++i) {
        if (!(location.weights[i] > 0.0f)) continue;
        const uint32_t probe = volume.cells[location.cell].vertices[i];
        const glm::vec3 from = traced_.render_from_world(volume.exact_positions[probe]);
        const glm::vec3 to = traced_.render_from_world(glm::dvec3(position));
        if (!blocked_fraction(traced_, from, to)) seen[i] = location.weights[i];
        sum += seen[i];
    }
    if (sum > 0.0f) location.weights = seen / sum;
    answers.rays.push_back(interpolate(volume, location, {Walls::Ignore}).irradiance);
    answers.is_seen.push_back(sum > 0.0f);
}

void LeakVolume::report_cost(const std::string& prefix, const std::string& suffix) const {
    const ProbeVolumeView volume = view();
    const auto bytes = volume.visibility_blocks.size_bytes() + volume.cell_visibility.size_bytes();
    report(str_cat(prefix, ".bytes", suffix),
           static_cast<double>(bytes) / static_cast<double>(volume.positions.size()),
           str_cat("bytes a probe of ", volume.positions.size()));
    const BakeReport& times = baked_.report;
    report(str_cat(prefix, ".bake_cost", suffix),
           100.0 * times.visibility.seconds / times.bake_seconds, "% of the time of the bake");
}

double mean_light(const std::vector<IrradianceSh>& answers) {
    double sum = 0.0;
    for (const IrradianceSh& light : answers) sum += mean_irradiance(light);
    return sum / static_cast<double>(answers.size());
}

}  // namespace tetralight::bench
