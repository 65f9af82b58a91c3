// SPDX-License-Identifier: Apache-2.0
#include <tetralight/pipeline/stored_bake.h>

#include <utility>

#include <tetralight/pipeline/probe_store.h>

namespace tetralight {
namespace {

/// Samples between two points at which a bake can be saved, if it is saved every second or more.
constexpr uint64_t kFrequentSamples = 1u << 17;

/// Loads probes from stores and saves them. Without stores it does nothing.
class Keeper {
  public:
    Keeper(const Scene& scene, const BakePlaces& places, const BakeSettings& settings,
           const BakeStorage& storage, const BakeSums& sums)
        : storage_(storage) {
        if (storage.target == nullptr && storage.sources.empty()) return;
        probes_.emplace(scene, settings, places, sums.accumulators, sums.rows);
        for (BakeStore* store : storage.sources) probes_->load(*store, store == storage.target);
    }

    void save() {
        if (storage_.target == nullptr) return;
        const auto saved = probes_->save(*storage_.target);
        failure_ = saved ? std::nullopt : std::optional(saved.error());
        is_saved_ = is_saved_ || saved;
    }

    [[nodiscard]] bool must_stop() const { return storage_.is_required && failure_; }

    [[nodiscard]] const std::optional<Error>& failure() const { return failure_; }

    [[nodiscard]] bool is_saved() const { return is_saved_; }

  private:
    const BakeStorage& storage_;
    std::optional<ProbeStore> probes_;
    std::optional<Error> failure_;
    bool is_saved_ = false;
};

uint64_t ray_count(std::span<const ProbeAccumulator> accumulators) {
    uint64_t sum = 0;
    for (const ProbeAccumulator& accumulator : accumulators) sum += accumulator.ray_count;
    return sum;
}

/// Bakes all places to the end and saves them on the way.
Status bake_and_save(const Scene& scene, const BakePlaces& places, const BakeSettings& settings,
                     const BakeStorage& storage, const BakeSums& sums, Keeper& keeper,
                     BakeHooks hooks) {
    if (places.positions.empty()) return Ok{};
    const BakeCallback callback = std::exchange(hooks.progress, {});
    hooks.progress = [&](const BakeProgress& progress) {
        return !keeper.must_stop() && (!callback || callback(progress));
    };
    hooks.save_seconds = storage.save_seconds;
    if (storage.target != nullptr) hooks.save = [&] { keeper.save(); };
    if (storage.save_seconds < 1.0) hooks.samples_between_saves = kFrequentSamples;
    const Status status =
        bake_accumulators(scene, places, settings, sums.accumulators, hooks, sums.rows);
    if (keeper.must_stop()) return *keeper.failure();
    if (!status || storage.is_saved_at_end) keeper.save();
    if (keeper.must_stop()) return *keeper.failure();
    return status;
}

}  // namespace

Result<StoredBake> bake_with_stores(const Scene& scene, const BakePlaces& places,
                                    const BakeSettings& settings, const BakeStorage& storage,
                                    const BakeSums& sums, BakeHooks hooks) {
    Keeper keeper(scene, places, settings, storage, sums);
    StoredBake stored;
    stored.earlier_ray_count = ray_count(sums.accumulators);
    hooks.out_of_time = [&](uint64_t samples) { stored.samples_in_time = samples; };
    const Status status =
        bake_and_save(scene, places, settings, storage, sums, keeper, std::move(hooks));
    if (!status && keeper.failure()) {
        return keeper.failure()->in("interrupted; what is done could not be kept");
    }
    if (!status) return status.error();
    stored.is_saved = keeper.is_saved();
    stored.save_failure = keeper.failure();
    return stored;
}

}  // namespace tetralight
