// SPDX-License-Identifier: Apache-2.0
#include <tetralight/verify/trace_light.h>

#include <algorithm>
#include <bit>
#include <cmath>

namespace tetralight {
namespace {

/// Fewest batches that give a standard error worth its name.
constexpr uint64_t kFewestBatches = 16;

/// Part of a bright channel that counts as the light of a dark one.
constexpr double kLeastChannel = 0.01;

uint64_t key_of(uint64_t seed, const glm::dvec3& position) {
    uint64_t key = mixed_key(seed, 0);
    for (int axis = 0; axis < 3; ++axis) {
        key = mixed_key(key, std::bit_cast<uint64_t>(position[axis] + 0.0));  // −0 is 0
    }
    return key;
}

/// Independent batches at one position.
class Batches {
  public:
    Batches(const PlainTracer& tracer, const glm::dvec3& position, uint64_t key)
        : tracer_(tracer), position_(tracer.trace_scene().render_from_world(position)), key_(key) {}

    void add(uint64_t count) {
        for (uint64_t i = 0; i < count; ++i) {
            const RadianceShSum light = tracer_.trace_batch(position_, batch_random(key_, count_));
            ++count_;
            sum_ += light;
            const glm::dvec3 before = light.coefficients[0] - mean_;
            mean_ += before / static_cast<double>(count_);
            squares_ += before * (light.coefficients[0] - mean_);
        }
    }

    [[nodiscard]] TracedLight light() const {
        TracedLight light;
        const auto count = static_cast<double>(count_);
        const IrradianceSh irradiance =
            irradiance_from_radiance(radiance_from_sum(sum_, 1.0 / count));
        constexpr double kMeanPerCoefficient = 0.886226925452758;  // π Y_0 = √π / 2
        light.irradiance = irradiance;
        light.mean = kMeanPerCoefficient * mean_;
        light.error = kMeanPerCoefficient * glm::sqrt(squares_ / (count * (count - 1.0)));
        light.sample_count = count_ * PlainTracer::kBatchSize;
        return light;
    }

  private:
    const PlainTracer& tracer_;
    glm::vec3 position_;
    uint64_t key_;
    uint64_t count_ = 0;
    RadianceShSum sum_;
    glm::dvec3 mean_{0.0}, squares_{0.0};
};

/// The largest error of a channel, relative to what counts as its light.
double relative_error(const TracedLight& light) {
    const double brightest = std::max({light.mean.x, light.mean.y, light.mean.z});
    if (!(brightest > 0.0)) return 0.0;
    double largest = 0.0;
    for (int channel = 0; channel < 3; ++channel) {
        largest = std::max(largest, light.error[channel] /
                                        std::max(light.mean[channel], kLeastChannel * brightest));
    }
    return largest;
}

uint64_t batch_count(uint64_t samples) {
    return std::max(kFewestBatches,
                    (samples + PlainTracer::kBatchSize - 1) / PlainTracer::kBatchSize);
}

/// Batches for the target, by the error of a first look.
uint64_t needed_batches(const TracedLight& pilot, const TraceEffort& effort) {
    const uint64_t most = batch_count(effort.max_sample_count);
    const double ratio = relative_error(pilot) / effort.target_error;
    const double samples = ratio * ratio * static_cast<double>(pilot.sample_count);
    // No light was found, perhaps because few paths find it.
    if (pilot.mean == glm::dvec3(0.0)) return std::min(most, batch_count(1 << 16));
    if (samples >= static_cast<double>(effort.max_sample_count)) return most;
    return std::min(most, batch_count(static_cast<uint64_t>(samples)));
}

}  // namespace

TracedLight trace_light(const PlainTracer& tracer, const glm::dvec3& position,
                        const TraceEffort& effort) {
    const uint64_t key = key_of(effort.seed, position);
    uint64_t count = batch_count(effort.sample_count);
    if (effort.sample_count == 0) {
        Batches pilot(tracer, position, mixed_key(key, 1));
        pilot.add(kPilotSampleCount / PlainTracer::kBatchSize);
        count = needed_batches(pilot.light(), effort);
    }
    Batches batches(tracer, position, key);
    batches.add(count);
    return batches.light();
}

}  // namespace tetralight
