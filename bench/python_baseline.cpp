// SPDX-License-Identifier: Apache-2.0
// What packages/python/bench compares with: a batch of the C++ library on threads, in the same
// process.
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <memory>
#include <span>
#include <thread>
#include <vector>

#include <tetralight/probes/interpolate.h>
#include <tetralight/probes/probe_file.h>

namespace {

using namespace tetralight;

/// Calls task(0) .. task(count - 1) on this many threads.
struct OnThreads {
    size_t thread_count = 1;

    template <class Task>
    void operator()(size_t count, Task task) const {
        std::atomic<size_t> next = 0;
        const auto work = [&] {
            for (size_t i = next++; i < count; i = next++) task(i);
        };
        std::vector<std::jthread> helpers;
        for (size_t i = 1; i < thread_count; ++i) helpers.emplace_back(work);
        work();
    }
};

struct Baseline {
    ProbeFile file;
    std::vector<glm::vec3> positions;
    std::vector<uint32_t> cells;
    std::vector<IrradianceSh> light;
    std::vector<glm::vec4> occlusion;
};

/// Memory that is not filled with zeros first.
template <class Value>
class Unfilled {
  public:
    explicit Unfilled(size_t count) : memory_(std::malloc(count * sizeof(Value))), count_(count) {}

    [[nodiscard]] std::span<Value> values() const {
        return {static_cast<Value*>(memory_.get()), count_};
    }

  private:
    struct Free {
        void operator()(void* memory) const { std::free(memory); }
    };

    std::unique_ptr<void, Free> memory_;
    size_t count_;
};

double seconds_of(const Baseline& baseline, std::span<uint32_t> cells,
                  std::span<IrradianceSh> light, std::span<glm::vec4> occlusion, size_t threads) {
    const auto begin = std::chrono::steady_clock::now();
    std::ranges::fill(cells, kNoIndex);
    InterpolationBatch batch;
    batch.positions = baseline.positions;
    batch.hints = cells;
    batch.irradiance = light;
    batch.occlusion = occlusion;
    const auto report = interpolate(baseline.file.view(), batch, OnThreads{threads});
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin;
    return report ? taken.count() : -1.0;
}

}  // namespace

extern "C" {

/// NULL if the file cannot be opened.
__attribute__((visibility("default"))) void* tetralight_baseline_open(const char* path,
                                                                      const float* positions,
                                                                      size_t count) {
    auto file = open_probe_file(path);
    if (!file) return nullptr;
    auto* baseline = new Baseline{std::move(*file), std::vector<glm::vec3>(count), {}, {}, {}};
    std::copy_n(positions, 3 * count, &baseline->positions[0].x);
    baseline->cells.resize(count);
    baseline->light.resize(count);
    baseline->occlusion.resize(count);
    return baseline;
}

/// Seconds of one batch into memory that batches before it have used.
__attribute__((visibility("default"))) double tetralight_baseline_run(void* handle,
                                                                      size_t threads) {
    auto& baseline = *static_cast<Baseline*>(handle);
    return seconds_of(baseline, baseline.cells, baseline.light, baseline.occlusion, threads);
}

/// The answers of the last run: 27 floats a position.
__attribute__((visibility("default"))) const float* tetralight_baseline_light(void* handle) {
    return &static_cast<Baseline*>(handle)->light[0].coefficients[0].x;
}

/// Seconds of one batch into new memory.
__attribute__((visibility("default"))) double tetralight_baseline_run_fresh(void* handle,
                                                                            size_t threads) {
    auto& baseline = *static_cast<Baseline*>(handle);
    const size_t count = baseline.positions.size();
    const auto begin = std::chrono::steady_clock::now();
    const Unfilled<uint32_t> cells(count);
    const Unfilled<IrradianceSh> light(count);
    const Unfilled<glm::vec4> occlusion(count);
    if (seconds_of(baseline, cells.values(), light.values(), occlusion.values(), threads) < 0.0) {
        return -1.0;
    }
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin;
    return taken.count();
}

__attribute__((visibility("default"))) void tetralight_baseline_close(void* handle) {
    delete static_cast<Baseline*>(handle);
}
}
