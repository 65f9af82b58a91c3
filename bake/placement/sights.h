// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <mutex>
#include <unordered_map>

#include <tetralight/bake/placement/light_pool.h>
#include <tetralight/bake/rays/trace_scene.h>

namespace tetralight {

/// Which positions of a pool see each other: rays that are traced once. Thread-safe.
class Sights {
  public:
    /// Keeps the references.
    Sights(const TraceScene& traced, const LightPool& pool) : traced_(traced), pool_(pool) {}

    /// True if half of the light or more gets from one position to another (`blocked_fraction`).
    [[nodiscard]] bool sees(uint32_t from, uint32_t to);

    [[nodiscard]] uint64_t ray_count() const { return ray_count_; }

  private:
    /// Pairs whose hash falls into one part.
    struct Part {
        std::mutex mutex;
        std::unordered_map<uint64_t, bool> known;
    };

    const TraceScene& traced_;
    const LightPool& pool_;
    std::array<Part, 64> parts_;
    std::atomic<uint64_t> ray_count_ = 0;
};

}  // namespace tetralight
