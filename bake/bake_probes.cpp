// SPDX-License-Identifier: Apache-2.0
#include "bake/bake_probes.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <mutex>
#include <numbers>

#include "bake/parallel.h"
#include "bake/path_tracer.h"
#include "bake/probe_estimator.h"
#include "bake/sampling.h"
#include "bake/scene/environment.h"
#include "bake/trace_scene.h"
#include "base/text.h"

namespace tetralight {
namespace {

/// Counts work from all threads and passes it on a few times a second.
class ProgressReporter {
  public:
    ProgressReporter(const BakeCallback& callback, size_t probe_count)
        : callback_(callback), probe_count_(probe_count) {}

    void add_probe() { probes_done_.fetch_add(1, std::memory_order_relaxed); }

    void add_rays(uint64_t rays) {
        ray_count_.fetch_add(rays, std::memory_order_relaxed);
        if (!callback_) return;
        const std::unique_lock lock(mutex_, std::try_to_lock);
        if (!lock.owns_lock()) return;
        const auto now = std::chrono::steady_clock::now();
        if (now - last_report_ < std::chrono::milliseconds(50)) return;
        last_report_ = now;
        if (!callback_({probes_done_, probe_count_, ray_count_})) is_cancelled_ = true;
    }

    [[nodiscard]] bool is_cancelled() const { return is_cancelled_; }

    [[nodiscard]] uint64_t ray_count() const { return ray_count_; }

    void finish() {
        if (callback_ && !is_cancelled_) callback_({probes_done_, probe_count_, ray_count_});
    }

  private:
    const BakeCallback& callback_;
    size_t probe_count_;
    std::atomic<size_t> probes_done_ = 0;
    std::atomic<uint64_t> ray_count_ = 0;
    std::atomic<bool> is_cancelled_ = false;
    std::mutex mutex_;
    std::chrono::steady_clock::time_point last_report_{};
};

/// Sum over one row of the sky, whose samples all have the same solid angle.
RadianceShSum environment_row(const Environment& environment, double polar_angle,
                              uint32_t columns) {
    RadianceShSum sum;
    const double y = std::cos(polar_angle), radius = std::sin(polar_angle);
    for (uint32_t column = 0; column < columns; ++column) {
        const double azimuth = 2.0 * std::numbers::pi * (column + 0.5) / columns;
        const glm::vec3 direction(radius * std::cos(azimuth), y, radius * std::sin(azimuth));
        sum.add(direction, environment_radiance(environment, direction));
    }
    return sum;
}

/// Midpoint rule with one sample a texel, each with its own solid angle, so that the smallest sun
/// counts as what it is. Texels of a small image are split, as the light varies within them.
RadianceSh project_environment(const Environment& environment, uint32_t thread_count) {
    const ImageF& image = environment.image;
    if (image.pixels.empty()) return constant_radiance(environment.radiance);
    const uint32_t split = 1 + 255 / std::min(image.width, image.height);
    const uint32_t columns = image.width * split, rows = image.height * split;
    const double row_angle = std::numbers::pi / rows;
    std::vector<RadianceShSum> row_sums(rows);
    parallel_for(rows, thread_count, [&](size_t row) {
        const double polar_angle = (static_cast<double>(row) + 0.5) * row_angle;
        row_sums[row] = environment_row(environment, polar_angle, columns);
    });
    RadianceShSum sum;
    for (uint32_t row = 0; row < rows; ++row) {
        const double height = std::cos(row * row_angle) - std::cos((row + 1) * row_angle);
        for (int i = 0; i < kShCoefficientCount; ++i) {
            sum.coefficients[i] += row_sums[row].coefficients[i] * height;
        }
    }
    return radiance_from_sum(sum, 2.0 * std::numbers::pi / columns);
}

Status check(std::span<const glm::dvec3> positions, const BakeSettings& settings) {
    if (settings.sample_count == 0) return Error{"samples: 0 is not a number of directions"};
    for (size_t i = 0; i < positions.size(); ++i) {
        const glm::dvec3& p = positions[i];
        if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) {
            return Error{
                text("probe ", i, ": position is not finite (", p.x, ", ", p.y, ", ", p.z, ")")};
        }
    }
    return Ok{};
}

}  // namespace

Result<BakedProbes> bake_probes(const Scene& scene, std::span<const glm::dvec3> positions,
                                const BakeSettings& settings, const BakeCallback& callback) {
    if (auto status = check(positions, settings); !status) return status.error();
    const auto traced = TraceScene::make_static(scene);
    if (!traced) return traced.error();
    const PathTracer tracer(scene, *traced, settings.bounces);

    BakedProbes baked;
    baked.radiance.resize(positions.size());
    baked.validity.resize(positions.size());
    baked.ambient = project_environment(scene.environment, settings.thread_count);
    ProgressReporter progress(callback, positions.size());
    parallel_for(positions.size(), settings.thread_count, [&](size_t i) {
        if (progress.is_cancelled()) return;
        const ProbeEstimate probe =
            estimate_probe(tracer, traced->traced_from_world(positions[i]),
                           probe_key(settings.seed, positions[i]), settings.sample_count);
        baked.radiance[i] = probe.radiance;
        baked.validity[i] = static_cast<float>(1.0 - static_cast<double>(probe.behind_count) /
                                                         probe.direction_count);
        progress.add_rays(probe.ray_count);
        progress.add_probe();
    });
    if (progress.is_cancelled()) return Error{"cancelled"};
    progress.finish();
    baked.ray_count = progress.ray_count();
    return baked;
}

}  // namespace tetralight
