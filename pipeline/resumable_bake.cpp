// SPDX-License-Identifier: Apache-2.0
#include <tetralight/pipeline/resumable_bake.h>

#include <filesystem>
#include <span>

#include <tetralight/bake/bake_accumulators.h>
#include <tetralight/base/error_text.h>
#include <tetralight/base/str_cat.h>

namespace tetralight {
namespace {

std::string name(const ProbeRange& range) {
    return str_cat("probes ", range.begin, "..", range.end);
}

/// What the kept file holds, if it is of this bake.
Result<PartialBake> resume(const std::string& path, const PreparedBake& prepared,
                           const ProbeRange& range) {
    auto part = read_part(path);
    if (!part) return part.error();
    if (part->prepared.key != prepared.key) {
        return Error{path +
                     ": is of another bake (scene, groups, settings or program version differ); "
                     "bake without --resume to begin anew"};
    }
    if (part->partial.range != range) {
        return Error{
            str_cat(path, ": is of ", name(part->partial.range), ", not of ", name(range))};
    }
    return std::move(part->partial);
}

uint64_t ray_count(std::span<const ProbeAccumulator> accumulators) {
    uint64_t sum = 0;
    for (const ProbeAccumulator& accumulator : accumulators) sum += accumulator.ray_count;
    return sum;
}

}  // namespace

Result<RangeBake> bake_range(const Scene& scene, const PreparedBake& prepared, ProbeRange range,
                             const BakeKeeping& keeping, const BakeCallback& callback) {
    const size_t probe_count = prepared.capture_positions.size();
    if (range.begin > range.end || range.end > probe_count) {
        const std::string asked =
            range.begin > probe_count ? str_cat("probe ", range.begin) : name(range);
        return Error{str_cat(asked, ": there are ", probe_count, " probes")};
    }
    RangeBake bake;
    const LightGroupLayout layout(prepared.settings.bake.plan);
    bake.partial = {range, std::vector<ProbeAccumulator>(range.count()), false,
                    std::vector<double>(range.count() * layout.size())};
    if (keeping.is_resumed && std::filesystem::exists(keeping.path)) {
        auto kept = resume(keeping.path, prepared, range);
        if (!kept) return kept.error();
        bake.partial = std::move(*kept);
        bake.partial.is_finished = false;
        bake.is_kept = true;
    }
    std::vector<ProbeAccumulator>& accumulators = bake.partial.accumulators;
    bake.earlier_ray_count = ray_count(accumulators);

    const auto keep = [&] {
        const Status status = write_part(keeping.path, prepared, bake.partial);
        bake.warning = status ? "" : error_text(status.error());
        bake.is_kept = bake.is_kept || status;
    };
    BakeHooks hooks{.progress = callback, .save_seconds = keeping.save_seconds};
    if (!keeping.path.empty()) hooks.save = keep;
    const auto positions =
        std::span(prepared.capture_positions).subspan(range.begin, range.count());
    LightGroupRows split{bake.partial.split_rows, prepared.volume.occlusion_lights};
    if (layout.has_occlusion) {
        split.occlusion_lights = split.occlusion_lights.subspan(range.begin, range.count());
    }
    const Status status =
        bake_accumulators(scene, positions, prepared.settings.bake, accumulators, hooks, split);
    if (!status) {
        if (hooks.save) keep();
        return bake.warning.empty() ? status.error() : Error{bake.warning};
    }
    bake.partial.is_finished = true;
    return bake;
}

}  // namespace tetralight
