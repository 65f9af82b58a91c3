// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/placement/reach.h>

#include <algorithm>
#include <map>
#include <utility>

#include <tetralight/bake/placement/group_by_region.h>
#include <tetralight/bake/probe_visibility.h>
#include <tetralight/base/str_cat.h>

namespace tetralight {
namespace {

Status check_seed(const TraceScene& traced, const SpaceMap& map, const glm::dvec3& seed) {
    const std::string place = str_cat("seed ", seed.x, ",", seed.y, ",", seed.z);
    if (!map.contains(seed)) return Error{place + " lies outside of the bounds"};
    const glm::vec3 position = traced.render_from_world(seed);
    if (standing_of(traced, position, probe_visibility(traced, position)) == Standing::Inside) {
        return Error{place + " lies inside geometry"};
    }
    if (map.space_of(seed) == kNoIndex) {
        return Error{place + " lies in a gap that is too narrow to be searched"};
    }
    return Ok{};
}

std::vector<uint32_t> sorted_once(std::vector<uint32_t> spaces) {
    std::ranges::sort(spaces);
    spaces.erase(std::ranges::unique(spaces).begin(), spaces.end());
    return spaces;
}

std::vector<uint32_t> wanted_spaces(const SpaceMap& map, const ProbeGridSettings& settings,
                                    const std::vector<uint32_t>& spaces) {
    std::vector<uint32_t> wanted = spaces;
    if (settings.other_spaces == OtherSpaces::Drop) {
        wanted = spaces_by_size(spaces);
        wanted.resize(std::min<size_t>(wanted.size(), 1));
        if (!settings.seeds.empty()) wanted = map.spaces_of(settings.seeds);
    }
    return sorted_once(std::move(wanted));
}

}  // namespace

Result<Reach> drop_unreachable(const TraceScene& traced, SpaceMap& map,
                               const ProbeGridSettings& settings,
                               std::vector<PlacedProbe>& probes) {
    std::vector<glm::dvec3> positions;
    for (const PlacedProbe& probe : probes) {
        if (is_kept(probe.fate)) positions.push_back(probe.position);
    }
    for (const glm::dvec3& seed : settings.seeds) {
        if (auto status = check_seed(traced, map, seed); !status) return status.error();
    }
    map.join(positions, settings.thread_count);
    map.join(settings.seeds, settings.thread_count);
    const std::vector<uint32_t> spaces = map.spaces_of(positions, settings.thread_count);
    Reach reach;
    reach.filled = sorted_once(spaces);
    reach.wanted = wanted_spaces(map, settings, spaces);
    std::map<uint32_t, Pocket> pockets;
    size_t i = 0;
    for (PlacedProbe& probe : probes) {
        if (!is_kept(probe.fate)) continue;
        const uint32_t space = spaces[i++];
        if (std::ranges::binary_search(reach.wanted, space)) {
            reach.spaces.push_back(space);
            continue;
        }
        Pocket& pocket = pockets[space];
        if (pocket.probe_count++ == 0) pocket.position = probe.position;
        probe.fate = Fate::Unreachable;
    }
    for (const auto& [space, pocket] : pockets) reach.pockets.push_back(pocket);
    std::ranges::stable_sort(reach.pockets, std::greater{}, &Pocket::probe_count);
    return reach;
}

}  // namespace tetralight
