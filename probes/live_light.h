// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <span>
#include <vector>

#include <tetralight/base/result.h>
#include <tetralight/probes/probe_volume.h>

// A volume whose light changes while other threads read it: one thread recombines layers, some
// probes a frame, and any number of threads query the last complete result.
//
//     LiveLight light(file->view());
//     auto status = light.begin(weights);                     // when a lamp is dimmed
//     light.step(4096);                                       // each frame, on one thread
//     const auto reading = light.read();                      // on any thread
//     auto report = interpolate(reading.view(), batch);

namespace tetralight {

/// Two sets of compact probes over one volume. Readers hold the one that was published last; the
/// writer fills the other, and publishes it when every probe is there. So a reader never sees a
/// probe that is half written, nor a mix of old and new ones.
///
/// Memory model. `begin` and `step` are for one thread at a time (the writer); `read` and readings
/// are for any. All hand-overs are sequentially consistent atomics: publishing is a store of the
/// set's number after its probes are written; a reader increments the count of a set, then checks
/// that the set is still the published one; the writer publishes first and looks at the count of
/// the other set afterwards. So either the reader sees the new number and releases the set, or the
/// writer sees the count and waits. No call blocks: `step` does nothing while a reader still holds
/// the set that it would overwrite.
///
/// Queries see half precision: 64 bytes a probe and set. No allocation after the constructor.
class LiveLight {
    struct Set;

  public:
    /// Keeps the view, whose owner must outlive this object. It begins with the light of the
    /// volume. Returns invalid_argument if the volume has no layers.
    [[nodiscard]] static Result<LiveLight> make(const ProbeVolumeView& volume);

    LiveLight(LiveLight&& other) noexcept;
    LiveLight& operator=(LiveLight&&) = delete;
    ~LiveLight() = default;

    /// Begins a recombination and abandons an unfinished one. Returns the errors of
    /// `check_weights`.
    [[nodiscard]] Status begin(std::span<const float> weights);

    /// Recombines up to `probe_count` more probes, and publishes the light after the last one. True
    /// when the recombination is done.
    bool step(uint32_t probe_count);

    /// What one reader queries. Destroy it soon: the next change of light waits for it.
    class Reading {
      public:
        Reading(Reading&& other) noexcept : set_(other.set_), view_(other.view_) {
            other.set_ = nullptr;
        }

        Reading& operator=(Reading&&) = delete;

        ~Reading() {
            if (set_ != nullptr) set_->reader_count.fetch_sub(1);
        }

        /// The volume with the light of this reading. Valid as long as the reading.
        [[nodiscard]] const ProbeVolumeView& view() const noexcept { return view_; }

      private:
        friend class LiveLight;

        Reading(Set* set, const ProbeVolumeView& view) : set_(set), view_(view) {}

        Set* set_;
        ProbeVolumeView view_;
    };

    [[nodiscard]] Reading read() const;

  private:
    struct Set {
        std::vector<CompactProbe> probes;
        std::vector<Layer> layers;
        VolumeInfo info;
        std::atomic<uint32_t> reader_count = 0;
    };

    explicit LiveLight(const ProbeVolumeView& volume);

    ProbeVolumeView volume_;
    mutable std::array<Set, 2> sets_;
    std::atomic<uint32_t> published_ = 0;
    // The writer's.
    std::vector<float> weights_;
    VolumeInfo next_info_;
    uint32_t next_probe_ = 0;
    bool is_under_way_ = false;
    bool is_set_free_ = false;
};

}  // namespace tetralight
