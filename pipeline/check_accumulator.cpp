// SPDX-License-Identifier: Apache-2.0
#include <tetralight/pipeline/check_accumulator.h>

#include <algorithm>
#include <cmath>

#include <tetralight/probes/is_finite.h>

namespace tetralight {
namespace {

bool is_possible(const CutLight& cut) {
    const auto is_throughput = [](double sum) { return std::isfinite(sum) && sum >= 0.0; };
    return is_finite(cut.last_radiance) && is_throughput(cut.last_throughput) &&
           is_throughput(cut.cut_throughput);
}

}  // namespace

bool is_possible(const ProbeAccumulator& accumulator, const RoundPlan& plan) {
    const auto is_sound = [](const glm::dvec3& c) { return is_finite(c); };
    const uint64_t rounds = accumulator.round_count;
    return std::ranges::all_of(accumulator.radiance_sum, is_sound) &&
           std::isfinite(accumulator.variance_sum) && accumulator.variance_sum >= 0.0 &&
           is_possible(accumulator.cut) && (rounds == 0 || plan.samples_in_round(rounds - 1) > 0) &&
           accumulator.sample_count == plan.samples_before(rounds) &&
           accumulator.back_face_count <= accumulator.sample_count;
}

}  // namespace tetralight
