// SPDX-License-Identifier: Apache-2.0
#include <tetralight/pipeline/check_leaks.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

#include <tetralight/bake/bake_probes.h>
#include <tetralight/bake/parallel.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/pipeline/bake_metadata.h>
#include <tetralight/pipeline/baked_sum.h>
#include <tetralight/pipeline/free_places.h>
#include <tetralight/pipeline/lighting_plan.h>
#include <tetralight/probes/interpolate.h>

namespace tetralight {
namespace {

/// Positions that are drawn at most for each place.
constexpr uint32_t kMostDraws = 100;

/// Mean irradiance over all normals, as luminance.
double mean_light(const IrradianceSh& irradiance) {
    constexpr double kFirstBasis = 0.28209479177387814;  // 1 / (2 √π)
    const glm::dvec3 light(irradiance.coefficients[0]);
    return kFirstBasis * (0.2126 * light.x + 0.7152 * light.y + 0.0722 * light.z);
}

Error refusal(const char* field, const std::string& reason) {
    return {ErrorCode::InvalidArgument, field, "", reason};
}

Status check(const ProbeVolumeView& volume, const LeakSettings& settings) {
    if (settings.place_count == 0) return refusal("places", "there has to be a place at least");
    if (settings.sample_count < 2) return refusal("samples", "there have to be two at least");
    if (!(settings.clearance >= 0.0f)) return refusal("clearance", "has to be 0 m or more");
    if (volume.positions.empty()) return refusal("volume", "the volume has no probes");
    if (volume.irradiance.empty() && volume.compact.empty()) {
        return refusal("volume", "the volume holds no light (it was not baked)");
    }
    return Ok{};
}

/// The light that is traced at places: two independent estimates of each.
struct TracedLight {
    std::vector<double> first, second;
};

Result<std::vector<double>> trace_light(const Scene& scene,
                                        const std::vector<glm::dvec3>& positions,
                                        const BakeSettings& settings,
                                        const BakeCallback& callback) {
    const auto baked = bake_probes(scene, positions, settings, callback);
    if (!baked) return baked.error();
    std::vector<double> light;
    for (const RadianceSh& radiance : baked->radiance) {
        light.push_back(mean_light(irradiance_from_radiance(radiance)));
    }
    return light;
}

/// As the probes of the volume were baked, but with a fixed number of samples.
Result<BakeSettings> truth_settings(const Scene& scene, const BakeVolumeSettings& recorded,
                                    const LeakSettings& settings) {
    auto plan = plan_lighting(scene, {recorded.lighting.mixed_lighting, {}});
    if (!plan) return plan.error();
    BakeSettings truth;
    truth.sample_count = (settings.sample_count + 1) / 2;
    truth.clamp = recorded.bake.clamp;
    truth.bounces = recorded.bake.bounces;
    truth.surfaces = recorded.bake.surfaces;
    truth.plan.light_modes = std::move(plan->bake.light_modes);
    truth.seed = settings.seed;
    truth.thread_count = settings.thread_count;
    return truth;
}

Result<TracedLight> trace_twice(const Scene& scene, const std::vector<glm::dvec3>& positions,
                                BakeSettings settings, const BakeCallback& callback) {
    auto first = trace_light(scene, positions, settings, callback);
    if (!first) return first.error();
    constexpr uint64_t kOtherSeed = uint64_t{1} << 63;
    settings.seed ^= kOtherSeed;
    auto second = trace_light(scene, positions, settings, callback);
    if (!second) return second.error();
    return TracedLight{std::move(*first), std::move(*second)};
}

double light_at(const ProbeVolumeView& volume, const CellLocation& location, Walls walls) {
    return mean_light(interpolate(volume, location, {walls}).irradiance);
}

/// The location with the weights of seen corners alone; the same bits if all are seen.
CellLocation seen_location(const FreePlace& place) {
    CellLocation location = place.location;
    bool hides_any = false;
    float sum = 0.0f;
    for (int i = 0; i < 4; ++i) {
        const bool is_hidden = !place.is_seen[static_cast<size_t>(i)];
        hides_any = hides_any || (is_hidden && location.weights[i] > 0.0f);
        if (is_hidden) location.weights[i] = 0.0f;
        sum += location.weights[i];
    }
    if (!hides_any) return place.location;
    location.weights /= sum;
    return location;
}

/// See `LeakPlace::hidden`.
double hidden_light(const ProbeVolumeView& volume, const FreePlace& place, double by_rays) {
    CellLocation hidden = visible_location(volume, place.location);
    double weight = 0.0;
    for (int i = 0; i < 4; ++i) {
        if (place.is_seen[static_cast<size_t>(i)]) hidden.weights[i] = 0.0f;
        weight += double{hidden.weights[i]};
    }
    return weight > 0.0 ? light_at(volume, hidden, Walls::Ignore) - weight * by_rays : 0.0;
}

LeakPlace compare(const ProbeVolumeView& volume, const FreePlace& place, double first,
                  double second) {
    LeakPlace leak;
    leak.position = glm::dvec3(place.position);
    leak.is_unseen = place.is_unseen();
    leak.traced = 0.5 * (first + second);
    leak.noise = 0.5 * std::abs(first - second);
    leak.answer = light_at(volume, place.location, Walls::HideProbes);
    leak.plain = light_at(volume, place.location, Walls::Ignore);
    leak.by_rays =
        leak.is_unseen ? leak.traced : light_at(volume, seen_location(place), Walls::Ignore);
    leak.hidden = hidden_light(volume, place, leak.by_rays);
    return leak;
}

template <class Amount>
LeakPart part_of(const LeakReport& report, Amount amount) {
    std::vector<double> values;
    for (const LeakPlace& place : report.places) {
        values.push_back(std::invoke(amount, place) / report.mean_light);
    }
    LeakPart part;
    part.mean =
        std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
    std::ranges::sort(values);
    part.p95 = values[(values.size() * 95 + 99) / 100 - 1];
    return part;
}

Result<LeakReport> make_report(std::vector<LeakPlace> places) {
    LeakReport report;
    report.places = std::move(places);
    for (const LeakPlace& place : report.places) {
        report.unseen_count += place.is_unseen;
        report.mean_light += place.traced;
    }
    report.mean_light /= static_cast<double>(report.places.size());
    if (!(report.mean_light > 0.0)) {
        return refusal("scene", str_cat("no light arrives at any of ", report.places.size(),
                                        " free places: there is nothing to compare with"));
    }
    report.through_walls = part_of(report, &LeakPlace::through_walls);
    report.missing = part_of(report, &LeakPlace::missing);
    report.plain_through_walls = part_of(report, &LeakPlace::plain_through_walls);
    report.plain_missing = part_of(report, &LeakPlace::plain_missing);
    report.rest = part_of(report, &LeakPlace::rest);
    report.noise = part_of(report, &LeakPlace::noise).mean;
    return report;
}

Result<FreePlaces> find_places(const Scene& scene, const ProbeVolumeView& volume,
                               float min_validity, const LeakSettings& settings) {
    const auto traced = TraceScene::make_static(scene);
    if (!traced) return traced.error();
    const ProbeEyes eyes = make_probe_eyes(*traced, volume, min_validity, settings.thread_count);
    FreePlaces found = find_free_places(*traced, eyes, volume,
                                        {.count = settings.place_count,
                                         .clearance = settings.clearance,
                                         .seed = settings.seed,
                                         .most_draws = kMostDraws,
                                         .min_validity = min_validity,
                                         .thread_count = settings.thread_count});
    if (!found.places.empty()) return found;
    return Error{
        ErrorCode::NotFound, "places", "",
        str_cat("none of ", found.drawn_count, " places around the probes is in free space, ",
                settings.clearance, " m or more off surfaces, and in sight of a probe")};
}

}  // namespace

std::vector<uint32_t> LeakReport::worst_places(size_t count) const {
    std::vector<uint32_t> indices;
    for (uint32_t i = 0; i < places.size(); ++i) {
        if (places[i].through_walls() > 0.0) indices.push_back(i);
    }
    std::ranges::stable_sort(indices, [&](uint32_t a, uint32_t b) {
        return places[a].through_walls() > places[b].through_walls();
    });
    if (indices.size() > count) indices.resize(count);
    return indices;
}

Result<LeakReport> check_leaks(const Scene& scene, const ProbeVolumeView& volume,
                               const LeakSettings& settings, const BakeCallback& callback) {
    if (auto status = check(volume, settings); !status) return status.error();
    if (was_relit(volume.metadata)) {
        return refusal("volume", "the volume was relit: its light is not that of the scene");
    }
    const auto recorded = recorded_settings(volume.metadata);
    if (!recorded) return recorded.error();
    const auto sum = BakedSum::make(volume);
    if (!sum) return sum.error();
    const auto truth = truth_settings(scene, *recorded, settings);
    if (!truth) return truth.error();
    const auto found = find_places(scene, volume, recorded->health.min_validity, settings);
    if (!found) return found.error();

    std::vector<glm::dvec3> positions;
    for (const FreePlace& place : found->places) positions.emplace_back(place.position);
    const auto light = trace_twice(scene, positions, *truth, callback);
    if (!light) return light.error();
    std::vector<LeakPlace> places(positions.size());
    parallel_for(places.size(), settings.thread_count, [&](size_t i) {
        places[i] = compare(sum->view(), found->places[i], light->first[i], light->second[i]);
    });
    return make_report(std::move(places));
}

}  // namespace tetralight
