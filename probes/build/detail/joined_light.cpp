// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/build/detail/joined_light.h>

#include <algorithm>
#include <bit>

#include <tetralight/probes/compact_probes.h>
#include <tetralight/probes/edge_visibility.h>
#include <tetralight/probes/rendering_layers.h>

namespace tetralight::detail {
namespace {

using Parts = std::span<const LitPart* const>;
using Sources = std::span<const LightSource>;

/// One array of the volume. `of(part)`: that of a part.
template <class T, class Of>
void set_array(Parts parts, Sources sources, std::span<const uint32_t> changed, const T& missing,
               const Of& of, std::vector<T>& values) {
    const auto has = [&](const LitPart* part) { return !of(part->view).empty(); };
    const bool was_there = !values.empty();
    if (std::ranges::none_of(parts, has)) {
        values.clear();
        return;
    }
    const auto set = [&](uint32_t probe) {
        const auto& [part, index] = sources[probe];
        values[probe] = part != nullptr && has(part) ? of(part->view)[index] : missing;
    };
    values.resize(sources.size(), missing);
    if (was_there) {
        for (const uint32_t probe : changed) set(probe);
    } else {
        for (uint32_t probe = 0; probe < sources.size(); ++probe) set(probe);
    }
}

/// None if no edge of the cell is blocked or unknown.
std::optional<CellVisibility> visibility_of(const Cell& cell, Sources sources) {
    const auto common_part = [&](uint32_t a, uint32_t b) {
        return sources[a].part == sources[b].part && sources[a].part->walls ? sources[a].part
                                                                            : nullptr;
    };
    CellVisibility visibility;
    bool is_stored = false;
    for_each_edge(cell, [&](size_t i, size_t k) {
        const uint32_t from = cell.vertices[i], to = cell.vertices[k];
        const LitPart* part = common_part(from, to);
        const uint8_t code = part == nullptr
                                 ? uint8_t{kUnknownEdge}
                                 : part->walls->code(sources[from].index, sources[to].index);
        visibility.codes[edge_place(i, k)] = code;
        is_stored |= code >= kUnknownEdge;
    });
    if (!is_stored) return std::nullopt;
    set_splits(cell, visibility, [&](uint32_t from, uint32_t a, uint32_t b) {
        const LitPart* part = common_part(from, a);
        return part != nullptr && part == sources[b].part &&
               part->walls->is_split(sources[from].index, sources[a].index, sources[b].index);
    });
    return visibility;
}

bool knows_walls(Sources sources) {
    return std::ranges::any_of(sources, [](const LightSource& source) {
        return source.part != nullptr && source.part->walls;
    });
}

}  // namespace

void JoinedWalls::set_all(Sources sources, ProbeVolume& volume) {
    visibility_.clear();
    stored_.clear();
    std::vector<uint32_t> all(volume.cells.size());
    for (uint32_t i = 0; i < all.size(); ++i) all[i] = i;
    set(all, static_cast<uint32_t>(all.size()), sources, volume);
}

void JoinedWalls::set(std::span<const uint32_t> cells, uint32_t end, Sources sources,
                      ProbeVolume& volume) {
    if (!knows_walls(sources)) {
        visibility_.clear();
        stored_.clear();
        return store(volume);
    }
    if (visibility_.empty() && cells.size() < volume.cells.size()) {
        return set_all(sources, volume);
    }
    visibility_.resize(volume.cells.size());
    stored_.resize((volume.cells.size() + 31) / 32, 0);
    const auto set = [&](uint32_t cell, const std::optional<CellVisibility>& visibility) {
        const uint32_t bit = uint32_t{1} << (cell % 32);
        stored_[cell / 32] = (stored_[cell / 32] & ~bit) | (visibility ? bit : 0);
        visibility_[cell] = visibility.value_or(CellVisibility());
    };
    for (const uint32_t cell : cells) set(cell, visibility_of(volume.cells[cell], sources));
    if (end < volume.cells.size()) {
        const auto copied = visibility_of(volume.cells[end], sources);
        for (uint32_t cell = end; cell < volume.cells.size(); ++cell) set(cell, copied);
    }
    store(volume);
}

void JoinedWalls::store(ProbeVolume& volume) const {
    volume.visibility_blocks.resize(stored_.size());
    volume.cell_visibility.clear();
    for (size_t block = 0; block < stored_.size(); ++block) {
        const auto first = static_cast<uint32_t>(volume.cell_visibility.size());
        volume.visibility_blocks[block] = {first, stored_[block]};
        for (uint32_t rest = stored_[block]; rest != 0; rest &= rest - 1) {
            const auto bit = static_cast<size_t>(std::countr_zero(rest));
            volume.cell_visibility.push_back(visibility_[32 * block + bit]);
        }
    }
}

void set_light(Parts parts, Sources sources, std::span<const uint32_t> changed,
               ProbeVolume& volume) {
    const auto set = [&](const auto& missing, const auto& of, auto& values) {
        set_array(parts, sources, changed, missing, of, values);
    };
    using View = ProbeVolumeView;
    set(
        IrradianceSh(), [](const View& v) { return v.irradiance; }, volume.irradiance);
    set(
        glm::vec4(1.0f), [](const View& v) { return v.occlusion; }, volume.occlusion);
    set(
        1.0f, [](const View& v) { return v.validity; }, volume.validity);
    set(
        ProbeHealth(), [](const View& v) { return v.health; }, volume.health);
    set(
        kAllRenderingLayers, [](const View& v) { return v.rendering_layers; },
        volume.rendering_layers);
    volume.info.ambient = parts.empty() ? IrradianceSh() : parts[0]->view.info.ambient;
    update_compact_probes(volume, changed);
}

}  // namespace tetralight::detail
