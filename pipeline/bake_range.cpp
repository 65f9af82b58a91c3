// SPDX-License-Identifier: Apache-2.0
#include <tetralight/pipeline/bake_range.h>

#include <algorithm>
#include <span>

#include <tetralight/bake/bake_accumulators.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/pipeline/probe_store.h>

namespace tetralight {
namespace {

/// Samples between two points at which a bake can be saved, if it is saved every second or more.
constexpr uint64_t kFrequentSamples = 1u << 17;

Status check_range(const ProbeRange& range, size_t probe_count) {
    if (range.begin <= range.end && range.end <= probe_count) return Ok{};
    const std::string asked = range.begin > probe_count
                                  ? str_cat("probe ", range.begin)
                                  : str_cat("probes ", range.begin, "..", range.end);
    return Error{ErrorCode::InvalidArgument, "probes", str_cat(range.begin, "..", range.end),
                 str_cat(asked, ": there are ", probe_count, " probes")};
}

/// Arrays of the probes of a range whose light is not reused.
struct UnknownProbes {
    std::vector<uint32_t> indices;  ///< in the range
    std::vector<glm::dvec3> positions;
    std::vector<OcclusionLights> occlusion_lights;
    std::vector<ProbeAccumulator> accumulators;
    std::vector<double> rows;
    size_t row_size = 0;

    UnknownProbes(const PreparedBake& prepared, const ProbeRange& range) {
        const auto is_reused = prepared.reused.flags(prepared.capture_positions.size());
        const auto& lights = prepared.volume.occlusion_lights;
        for (uint32_t probe = range.begin; probe < range.end; ++probe) {
            if (is_reused[probe]) continue;
            indices.push_back(probe - range.begin);
            positions.push_back(prepared.capture_positions[probe]);
            if (!lights.empty()) occlusion_lights.push_back(lights[probe]);
        }
        row_size = LightGroupLayout(prepared.settings.bake.plan).size();
        accumulators.resize(positions.size());
        rows.resize(positions.size() * row_size);
    }

    [[nodiscard]] LightGroupRows split() { return {rows, occlusion_lights}; }

    [[nodiscard]] uint64_t ray_count() const {
        uint64_t sum = 0;
        for (const ProbeAccumulator& accumulator : accumulators) sum += accumulator.ray_count;
        return sum;
    }

    [[nodiscard]] PartialBake in_range(const PreparedBake& prepared,
                                       const ProbeRange& range) const {
        PartialBake partial{range, std::vector<ProbeAccumulator>(range.count()),
                            std::vector<double>(range.count() * row_size),
                            slice(prepared.reused, range.begin, range.end)};
        for (size_t i = 0; i < indices.size(); ++i) {
            partial.accumulators[indices[i]] = accumulators[i];
            std::ranges::copy(
                std::span(rows).subspan(i * row_size, row_size),
                partial.split_rows.begin() + static_cast<ptrdiff_t>(indices[i] * row_size));
        }
        return partial;
    }
};

/// Loads probes from stores and saves them. Without stores it does nothing.
class Keeper {
  public:
    Keeper(const Scene& scene, const BakeSettings& settings, const BakeStorage& storage,
           UnknownProbes& probes)
        : storage_(storage) {
        if (storage.target == nullptr && storage.sources.empty()) return;
        probes_.emplace(scene, settings, probes.positions, probes.accumulators, probes.split());
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

/// Bakes all probes to the end and saves them on the way.
Status bake_unknown(const Scene& scene, const BakeSettings& settings, const BakeStorage& storage,
                    UnknownProbes& probes, Keeper& keeper, const BakeCallback& callback) {
    if (probes.positions.empty()) return Ok{};
    BakeHooks hooks{.save_seconds = storage.save_seconds};
    hooks.progress = [&](const BakeProgress& progress) {
        return !keeper.must_stop() && (!callback || callback(progress));
    };
    if (storage.target != nullptr) hooks.save = [&] { keeper.save(); };
    if (storage.save_seconds < 1.0) hooks.samples_between_saves = kFrequentSamples;
    const Status status = bake_accumulators(scene, probes.positions, settings, probes.accumulators,
                                            hooks, probes.split());
    if (keeper.must_stop()) return *keeper.failure();
    if (!status || storage.is_saved_at_end) keeper.save();
    if (keeper.must_stop()) return *keeper.failure();
    return status;
}

}  // namespace

Result<RangeBake> bake_range(const Scene& scene, const PreparedBake& prepared, ProbeRange range,
                             const BakeStorage& storage, const BakeCallback& callback) {
    const Status checked = check_range(range, prepared.capture_positions.size());
    if (!checked) return checked.error();
    const BakeSettings& settings = prepared.settings.bake;
    UnknownProbes probes(prepared, range);
    Keeper keeper(scene, settings, storage, probes);
    RangeBake bake;
    bake.earlier_ray_count = probes.ray_count();
    const Status status = bake_unknown(scene, settings, storage, probes, keeper, callback);
    if (!status && keeper.failure()) {
        return keeper.failure()->in("interrupted; what is done could not be kept");
    }
    if (!status) return status.error();
    bake.partial = probes.in_range(prepared, range);
    bake.is_saved = keeper.is_saved();
    bake.save_failure = keeper.failure();
    return bake;
}

}  // namespace tetralight
