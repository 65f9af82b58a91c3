// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/placement/flood_fill.h>

#include <algorithm>
#include <map>
#include <utility>

#include <tetralight/bake/placement/group_by_region.h>
#include <tetralight/bake/probe_visibility.h>
#include <tetralight/base/str_cat.h>

namespace tetralight {
namespace {

Status check_seed(const TraceScene& traced, const FreeSpaceMap& map, const glm::dvec3& seed) {
    const std::string value = str_cat(seed.x, ",", seed.y, ",", seed.z);
    const auto error = [&](const char* reason) {
        return Error{ErrorCode::InvalidArgument, "from", value,
                     str_cat("seed ", value, " is ", reason)};
    };
    if (!map.contains(seed)) return error("outside of the bounds");
    const glm::vec3 position = traced.render_from_world(seed);
    if (classify_point(traced, position, probe_visibility(traced, position)) ==
        PointClass::Inside) {
        return error("inside geometry");
    }
    if (map.space_of(seed) == kNoIndex) {
        return error("in a gap that is too narrow for the flood fill");
    }
    return Ok{};
}

std::vector<uint32_t> sorted_once(std::vector<uint32_t> spaces) {
    std::ranges::sort(spaces);
    spaces.erase(std::ranges::unique(spaces).begin(), spaces.end());
    return spaces;
}

std::vector<uint32_t> wanted_spaces(const FreeSpaceMap& map, const ProbeGridSettings& settings,
                                    const std::vector<uint32_t>& spaces) {
    std::vector<uint32_t> wanted = spaces;
    if (settings.unreachable == UnreachableSpaces::Drop) {
        wanted = spaces_by_size(spaces);
        wanted.resize(std::min<size_t>(wanted.size(), 1));
        if (!settings.from.empty()) wanted = map.spaces_of(settings.from);
    }
    return sorted_once(std::move(wanted));
}

}  // namespace

Result<FloodFill> drop_unreachable(const TraceScene& traced, FreeSpaceMap& map,
                                   const ProbeGridSettings& settings,
                                   std::vector<PlacedProbe>& probes) {
    std::vector<glm::dvec3> positions;
    for (const PlacedProbe& probe : probes) {
        if (is_kept(probe.fate)) positions.push_back(probe.position);
    }
    for (const glm::dvec3& seed : settings.from) {
        if (auto status = check_seed(traced, map, seed); !status) return status.error();
    }
    map.join(positions, settings.thread_count);
    map.join(settings.from, settings.thread_count);
    const std::vector<uint32_t> spaces = map.spaces_of(positions, settings.thread_count);
    FloodFill fill;
    fill.filled = sorted_once(spaces);
    fill.wanted = wanted_spaces(map, settings, spaces);
    std::map<uint32_t, DroppedSpace> dropped;
    size_t i = 0;
    for (PlacedProbe& probe : probes) {
        if (!is_kept(probe.fate)) continue;
        const uint32_t space = spaces[i++];
        if (std::ranges::binary_search(fill.wanted, space)) {
            fill.spaces.push_back(space);
            continue;
        }
        DroppedSpace& dropped_space = dropped[space];
        if (dropped_space.probe_count++ == 0) dropped_space.position = probe.position;
        probe.fate = Fate::Unreachable;
    }
    for (const auto& [space, probes_of] : dropped) fill.dropped_spaces.push_back(probes_of);
    std::ranges::stable_sort(fill.dropped_spaces, std::greater{}, &DroppedSpace::probe_count);
    return fill;
}

}  // namespace tetralight
