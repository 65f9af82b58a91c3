// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/build/volume_builder.h>

#include <algorithm>
#include <utility>

#include <tetralight/base/str_cat.h>
#include <tetralight/probes/build/detail/canonical_cells.h>
#include <tetralight/probes/build/detail/delaunay.h>
#include <tetralight/probes/build/detail/spread.h>
#include <tetralight/probes/build/make_probe_volume.h>

namespace tetralight {
namespace {

/// `tetrahedralize` that reuses the tetrahedra of the last build. Flat sets have few probes and are
/// built from scratch.
Result<Tetrahedralization> tetrahedralize_next(const MergedProbes& probes,
                                               detail::KeptTetrahedra& kept) {
    const auto spread = detail::measure_spread(probes.positions, flat_tolerance(probes));
    if (spread.dimension == Dimension::Space) {
        auto cells = kept.change_to(probes.positions);
        if (!cells) return cells.error();
        if (!cells->empty()) return detail::with_hull_cells(std::move(*cells), Dimension::Space);
    }
    return tetrahedralize(probes.positions, flat_tolerance(probes));
}

}  // namespace

struct VolumeBuilder::Kept {
    detail::KeptTetrahedra tetrahedra;
};

VolumeBuilder::VolumeBuilder(const MergeSettings& settings)
    : settings_(settings), kept_(std::make_unique<Kept>()) {}

VolumeBuilder::~VolumeBuilder() = default;
VolumeBuilder::VolumeBuilder(VolumeBuilder&&) noexcept = default;
VolumeBuilder& VolumeBuilder::operator=(VolumeBuilder&&) noexcept = default;

Status VolumeBuilder::add_group(ProbeGroup group) {
    if (std::ranges::find(groups_, group.name, &ProbeGroup::name) != groups_.end()) {
        return Error{ErrorCode::InvalidArgument, "name", group.name,
                     str_cat("group \"", group.name, "\": there are two groups of this name")};
    }
    const auto alone = merge(std::span(&group, 1), settings_);
    if (!alone) return alone.error();
    groups_.push_back(std::move(group));
    return Ok{};
}

Status VolumeBuilder::remove_group(std::string_view name) {
    const auto group = std::ranges::find(groups_, name, &ProbeGroup::name);
    if (group == groups_.end())
        return Error{ErrorCode::NotFound, "name", std::string(name),
                     str_cat("group \"", name, "\": there is no such group")};
    groups_.erase(group);
    return Ok{};
}

Result<ProbeVolume> VolumeBuilder::build() {
    const MergedProbes probes = *merge(groups_, settings_);
    auto cells = tetrahedralize_next(probes, kept_->tetrahedra);
    if (!cells) return cells.error();
    return make_probe_volume(probes, std::move(*cells));
}

}  // namespace tetralight
