// SPDX-License-Identifier: Apache-2.0
#include <tetralight/cli/volume_facts.h>

#include <algorithm>
#include <array>

#include <tetralight/cli/info_probes.h>
#include <tetralight/cli/light_words.h>
#include <tetralight/cli/walls_report.h>
#include <tetralight/probes/build/quality.h>
#include <tetralight/probes/rendering_layers.h>
#include <tetralight/probes/seed_grid.h>
#include <tetralight/probes/volume_members.h>

namespace tetralight::cli {
namespace {

/// True for sections that no query reads (docs/file_format.md).
bool is_cold_section(const std::string& name) {
    bool is_cold = false;
    for_each_volume_member([&](const char* section, MemberUse use, auto, auto) {
        is_cold = is_cold || (name == section && use == MemberUse::Offline);
    });
    return is_cold;
}

Json groups_json(const ProbeVolumeView& volume) {
    const auto names = split_names(volume.group_names);
    std::vector<size_t> probe_counts(names.size(), 0);
    std::vector<size_t> left_out_counts(names.size(), 0);
    for (const ProbeSource& source : volume.sources) {
        ++(source.probe == kNoIndex ? left_out_counts : probe_counts)[source.group];
    }
    Json groups = Json::array();
    for (size_t i = 0; i < names.size(); ++i) {
        groups.push_back(
            {{"name", names[i]}, {"probes", probe_counts[i]}, {"left_out", left_out_counts[i]}});
    }
    return groups;
}

Json lights_json(const ProbeVolumeView& volume) {
    const auto names = split_names(volume.light_names);
    Json lights = Json::array();
    for (size_t i = 0; i < volume.lights.size(); ++i) {
        const Light& light = volume.lights[i];
        const LightState state =
            i < volume.light_states.size() ? volume.light_states[i] : LightState{};
        Json& one = lights.emplace_back(Json{{"name", i < names.size() ? names[i] : ""},
                                             {"type", name_of(light.type)},
                                             {"mode", name_of(light.mode)}});
        if (state.channel != kNoIndex) one["occlusion_channel"] = state.channel;
    }
    return lights;
}

Json layers_json(const ProbeVolumeView& volume) {
    Json layers = layer_noise_json(volume);
    for (size_t i = 0; i < layers.size(); ++i) layers[i]["weight"] = volume.layers[i].weight;
    return layers;
}

/// How many probes are on each layer; those on all layers are counted apart.
Json rendering_layers_json(const ProbeVolumeView& volume) {
    if (volume.rendering_layers.empty()) return nullptr;
    std::array<size_t, kRenderingLayerCount> counts{};
    size_t on_all = 0;
    for (const uint32_t layers : volume.rendering_layers) {
        on_all += layers == kAllRenderingLayers;
        for (uint32_t i = 0; layers != kAllRenderingLayers && i < counts.size(); ++i) {
            counts[i] += layers >> i & 1;
        }
    }
    Json list = Json::array();
    for (size_t i = 0; i < counts.size(); ++i) {
        if (counts[i] > 0) list.push_back({{"layer", i}, {"probes", counts[i]}});
    }
    return {{"list", list}, {"probes_on_all", on_all}};
}

Json bounds_json(const ProbeVolumeView& volume) {
    if (volume.positions.empty()) return nullptr;
    const Box<glm::vec3> bounds = probe_bounds(volume);
    return {{"min", to_json(glm::dvec3(bounds.min) + volume.info.world_origin)},
            {"max", to_json(glm::dvec3(bounds.max) + volume.info.world_origin)}};
}

std::optional<Slivers> count_slivers(const ProbeVolumeView& volume) {
    if (volume.info.dimension != Dimension::Space) return std::nullopt;
    const bool is_exact = !volume.exact_positions.empty();
    const auto position = [&](uint32_t probe) {
        return is_exact ? volume.exact_positions[probe] : glm::dvec3(volume.positions[probe]);
    };
    Slivers slivers;
    for (const Cell& cell : volume.cells.first(volume.info.inner_cell_count)) {
        const auto& v = cell.vertices;
        const double quality =
            tetrahedron_quality(position(v[0]), position(v[1]), position(v[2]), position(v[3]));
        slivers.below_1e3 += quality < 1e-3;
        slivers.below_1e6 += quality < 1e-6;
    }
    return slivers;
}

std::vector<SectionFacts> section_facts(const ProbeFile& file) {
    std::vector<SectionFacts> sections;
    for (const auto& section : file.sections()) {
        sections.push_back({section.name, section.size, !is_cold_section(section.name)});
    }
    return sections;
}

/// NaN, which JSON writes as null, if the whole is 0.
double per(uint64_t bytes, uint64_t probes) {
    return static_cast<double>(bytes) / static_cast<double>(probes);
}

Json slivers_json(const VolumeFacts& facts) {
    if (!facts.slivers) return nullptr;
    const uint64_t cells = facts.counts["inner_cells"];
    const Slivers& slivers = *facts.slivers;
    return {{"below_1e-3", slivers.below_1e3},
            {"below_1e-6", slivers.below_1e6},
            {"share_below_1e-3", per(slivers.below_1e3, cells)},
            {"share_below_1e-6", per(slivers.below_1e6, cells)}};
}

/// Cells at which walks can start: of each voxel of the seed grid; without one, seeds.
uint64_t seed_count(const ProbeVolumeView& volume) {
    const std::span<const uint32_t> words = volume.seed_grid;
    if (words.empty()) return volume.seeds.size();
    uint64_t count = 0;
    uint64_t place = 0;
    while (place + kSeedGridHeaderWords <= words.size()) {
        const uint64_t voxel_count = seed_voxel_count(seed_grid_header(words, place));
        place += kSeedGridHeaderWords;
        const uint64_t voxels = std::min<uint64_t>(voxel_count, words.size() - place);
        const auto is_cell = [](uint32_t word) { return (word & kFinerGrid) == 0; };
        count +=
            static_cast<uint64_t>(std::ranges::count_if(words.subspan(place, voxels), is_cell));
        place += voxels;
    }
    return count;
}

Json seeds_json(const VolumeFacts& facts) {
    if (!facts.walks) return nullptr;
    return {{"count", facts.seed_count},
            {"positions", facts.walks->position_count},
            {"hit_rate", facts.walks->seed_hit_rate},
            {"mean_steps", facts.walks->steps_from_seed}};
}

Json walks_json(const VolumeFacts& facts) {
    if (!facts.walks) return nullptr;
    return {{"positions", facts.walks->position_count},
            {"p50_steps", facts.walks->median_steps},
            {"p99_steps", facts.walks->p99_steps},
            {"max_steps", facts.walks->most_steps},
            {"fallbacks", facts.walks->fallback_count}};
}

Json visibility_json(const VolumeFacts& facts) {
    if (!facts.visibility) return nullptr;
    Json json{{"marked_cells", facts.visibility->marked_cells},
              {"edges", facts.visibility->edges},
              {"blocked_edges", facts.visibility->blocked_edges},
              {"unknown_edges", facts.visibility->unknown_edges},
              {"unclear_cells", nullptr},
              {"left_out_probes", nullptr}};
    if (facts.walls) {
        json["unclear_cells"] = facts.walls->unclear_cell_count;
        json["left_out_probes"] = facts.walls->left_out_count;
    }
    return json;
}

}  // namespace

uint64_t VolumeFacts::bytes() const {
    uint64_t sum = 0;
    for (const SectionFacts& section : sections) sum += section.bytes;
    return sum;
}

uint64_t VolumeFacts::resident_bytes() const {
    uint64_t sum = 0;
    for (const SectionFacts& section : sections) sum += section.is_resident ? section.bytes : 0;
    return sum;
}

VolumeFacts make_volume_facts(const std::string& path, const ProbeFile& file) {
    const ProbeVolumeView& volume = file.view();
    VolumeFacts facts;
    facts.path = path;
    facts.counts = counts(volume);
    facts.counts["left_out"] = left_out_count(volume);
    facts.groups = groups_json(volume);
    facts.lights = lights_json(volume);
    facts.layers = layers_json(volume);
    facts.rendering_layers = rendering_layers_json(volume);
    facts.noise = relit_noise(volume);
    facts.has_transfer = !volume.transfer.empty();
    facts.bounds = bounds_json(volume);
    facts.made_with = made_with(volume);
    facts.is_baked = !volume.irradiance.empty();
    facts.radial_fraction = static_cast<double>(volume.info.radial_fraction);
    facts.slivers = count_slivers(volume);
    if (volume.info.inner_cell_count > 0) facts.walks = measure_walks(volume);
    if (!volume.visibility_blocks.empty()) facts.visibility = visibility_facts(volume);
    facts.walls = read_walls(volume.metadata);
    facts.seed_count = seed_count(volume);
    facts.sections = section_facts(file);
    return facts;
}

Json to_json(const VolumeFacts& facts) {
    Json json{{"file", facts.path}};
    json.update(facts.counts);
    json.update({{"is_baked", facts.is_baked},
                 {"bounds", facts.bounds},
                 {"radial_share", facts.radial_fraction},
                 {"slivers", slivers_json(facts)},
                 {"seeds", seeds_json(facts)},
                 {"walks", walks_json(facts)},
                 {"visibility", visibility_json(facts)},
                 {"unseen", facts.walls ? to_json(facts.walls->unseen) : Json(nullptr)},
                 {"group_list", facts.groups},
                 {"lights", facts.lights},
                 {"layers", facts.layers},
                 {"standard_error", to_json(facts.noise)},
                 {"rendering_layers", facts.rendering_layers},
                 {"has_transfer", facts.has_transfer},
                 {"made_with", facts.made_with}});
    for (const SectionFacts& section : facts.sections) {
        json["section_bytes"][section.name] = section.bytes;
    }
    const uint64_t probes = facts.counts["probes"];
    const uint64_t resident = facts.resident_bytes();
    json.update({{"bytes", facts.bytes()},
                 {"resident_bytes", resident},
                 {"cold_bytes", facts.bytes() - resident},
                 {"bytes_per_probe", per(facts.bytes(), probes)},
                 {"resident_bytes_per_probe", per(resident, probes)}});
    return json;
}

}  // namespace tetralight::cli
