// SPDX-License-Identifier: Apache-2.0
#include <tetralight/pipeline/bake_range.h>

#include <algorithm>
#include <span>
#include <utility>

namespace tetralight {
namespace {

/// Arrays of the probes of a range whose light is not reused.
struct UnknownProbes {
    std::vector<uint32_t> indices;  ///< in the range
    std::vector<glm::dvec3> positions;
    std::vector<OcclusionLights> occlusion_lights;
    std::vector<ProbeAccumulator> accumulators;
    std::vector<double> rows;
    size_t row_size = 0;

    UnknownProbes(const PreparedBake& prepared, const PlaceRange& range) {
        const auto is_reused = prepared.reused.flags(prepared.capture_positions.size());
        const auto& lights = prepared.volume.occlusion_lights;
        for (uint32_t i = 0; i < range.count(); ++i) {
            const uint32_t probe = range[i];
            if (is_reused[probe]) continue;
            indices.push_back(i);
            positions.push_back(prepared.capture_positions[probe]);
            if (!lights.empty()) occlusion_lights.push_back(lights[probe]);
        }
        row_size = LightGroupLayout(prepared.settings.bake.plan).size();
        accumulators.resize(positions.size());
        rows.resize(positions.size() * row_size);
    }

    [[nodiscard]] LightGroupRows split() { return {rows, occlusion_lights}; }

    [[nodiscard]] PartialBake in_range(const PreparedBake& prepared,
                                       const PlaceRange& range) const {
        PartialBake partial{range, std::vector<ProbeAccumulator>(range.count()),
                            std::vector<double>(range.count() * row_size),
                            prepared.reused.in_range(range)};
        for (size_t i = 0; i < indices.size(); ++i) {
            partial.accumulators[indices[i]] = accumulators[i];
            std::ranges::copy(
                std::span(rows).subspan(i * row_size, row_size),
                partial.split_rows.begin() + static_cast<ptrdiff_t>(indices[i] * row_size));
        }
        return partial;
    }
};

}  // namespace

Result<RangeBake> bake_range(const Scene& scene, const PreparedBake& prepared, PlaceRange range,
                             const BakeStorage& storage, const BakeCallback& callback,
                             const RangePreview& preview) {
    const Status checked = check_range(range, {"probe", prepared.capture_positions.size()});
    if (!checked) return checked.error();
    const BakeSettings& settings = prepared.settings.bake;
    UnknownProbes probes(prepared, range);
    BakeHooks hooks{.progress = callback, .preview_seconds = preview.seconds};
    if (preview.show) hooks.preview = [&] { preview.show(probes.in_range(prepared, range)); };
    const auto stored = bake_with_stores(scene, {probes.positions}, settings, storage,
                                         {probes.accumulators, probes.split()}, std::move(hooks));
    if (!stored) return stored.error();
    RangeBake bake{{}, *stored};
    bake.partial = probes.in_range(prepared, range);
    return bake;
}

}  // namespace tetralight
