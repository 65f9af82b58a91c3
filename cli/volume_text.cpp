// SPDX-License-Identifier: Apache-2.0
// The form of `info` for people.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>

#include <tetralight/base/str_cat.h>
#include <tetralight/cli/info_probes.h>
#include <tetralight/cli/table.h>
#include <tetralight/cli/volume_facts.h>
#include <tetralight/cli/walls_report.h>

namespace tetralight::cli {
namespace {

using Rows = std::vector<std::vector<std::string>>;

/// "12.5 %"; "-" of nothing.
std::string percent(uint64_t part, uint64_t whole) {
    if (whole == 0) return "-";
    char buffer[32];
    const double fraction = 100.0 * static_cast<double>(part) / static_cast<double>(whole);
    std::snprintf(buffer, sizeof buffer, "%.1f %%", fraction);
    return buffer;
}

std::string bytes_text(uint64_t bytes) {
    return magnitude(static_cast<double>(bytes)) + "B";
}

/// Seeds and walks; see `WalkFacts`.
Rows walk_rows(const VolumeFacts& facts) {
    const WalkFacts& walks = *facts.walks;
    char mean[32];
    std::snprintf(mean, sizeof mean, "%.1f", walks.steps_from_seed);
    const auto hits =
        static_cast<uint64_t>(std::lround(walks.seed_hit_rate * walks.position_count));
    return {{"seeds", str_cat(grouped(facts.seed_count),
                              ", in the cell asked for: ", percent(hits, walks.position_count),
                              ", ", mean, " steps in the mean")},
            {"walks", str_cat("p50 ", walks.median_steps, ", p99 ", walks.p99_steps, ", max ",
                              counted(walks.most_steps, "step"), ", ",
                              counted(walks.fallback_count, "fallback"), " of ",
                              grouped(walks.position_count))}};
}

/// ", 5 cells with surfaces that edges do not show, 2 probes moved through a wall".
std::string unclear_text(const WallsMetadata& walls) {
    return str_cat(", ", counted(walls.unclear_cell_count, "cell"),
                   " with surfaces that edges do not show, ",
                   counted(walls.left_out_count, "probe"), " moved through a wall");
}

/// "123 of 4 567 cells partly hidden (2.7 %), 89 edges blocked (1.2 %), 3 not known".
std::string walls_text(const VolumeFacts& facts, size_t cell_count) {
    if (!facts.visibility) return "not known";
    const VisibilityFacts& walls = *facts.visibility;
    return str_cat(grouped(walls.marked_cells), " of ", counted(cell_count, "cell"),
                   " partly hidden (", percent(walls.marked_cells, cell_count), "), ",
                   grouped(walls.blocked_edges), " of ", counted(walls.edges, "edge"), " blocked (",
                   percent(walls.blocked_edges, walls.edges), "), ", grouped(walls.unknown_edges),
                   " not known", facts.walls ? unclear_text(*facts.walls) : "");
}

/// "1.5 2 3", at most six digits each.
std::string corner_text(const Json& corner) {
    std::string line;
    for (const Json& number : corner) {
        char buffer[32];
        std::snprintf(buffer, sizeof buffer, "%s%.6g", line.empty() ? "" : " ",
                      number.get<double>());
        line += buffer;
    }
    return line;
}

std::string name_text(const Json& name) {
    return printable(name.get<std::string>());
}

std::string lights_text(const Json& lights) {
    std::string line;
    for (const Json& light : lights) {
        const std::string channel =
            light.contains("occlusion_channel")
                ? str_cat(", occlusion ", light["occlusion_channel"].get<uint32_t>())
                : "";
        line += str_cat(line.empty() ? "" : ", ", name_text(light["name"]), " (",
                        name_text(light["type"]), ", ", name_text(light["mode"]), channel, ")");
    }
    return line.empty() ? "none" : line;
}

/// "sun 1, lamp 0.5, transfer".
std::string layers_text(const VolumeFacts& facts) {
    std::string line;
    for (const Json& layer : facts.layers) {
        line += str_cat(line.empty() ? "" : ", ", name_text(layer["name"]), " ",
                        layer["weight"].get<float>());
    }
    if (facts.has_transfer) line += "; transfer of distant light";
    return line.empty() ? "none (light cannot change; bake with --layers)" : line;
}

/// "0 (120 probes), 3 (40 probes), all (7 probes)".
std::string rendering_layers_text(const Json& layers) {
    std::string line;
    const auto add = [&](const std::string& name, uint64_t probes) {
        line += str_cat(line.empty() ? "" : ", ", name, " (", counted(probes, "probe"), ")");
    };
    for (const Json& layer : layers["list"]) add(layer["layer"].dump(), layer["probes"]);
    if (layers["probes_on_all"] > 0) add("all", layers["probes_on_all"]);
    return line;
}

std::string made_with_text(const Json& made_with) {
    std::string line;
    for (const auto& [key, value] : made_with.items()) {
        if (key == "walls") continue;  // in rows of their own
        const std::string shown = value.is_string() ? value.get<std::string>() : dump(value);
        line += (line.empty() ? "" : ", ") + (key == "generator" ? shown : key + " " + shown);
    }
    return printable(line);
}

Rows summary(const VolumeFacts& facts, const ProbeVolumeView& volume) {
    const uint64_t welded = facts.counts["welded"];
    const uint64_t inner = volume.info.inner_cell_count;
    const uint64_t left_out = facts.counts["left_out"];
    const std::string not_there = left_out > 0 ? ", " + grouped(left_out) + " left out" : "";
    Rows rows{{"probes", str_cat(grouped(volume.probe_count()), " (", grouped(welded), " welded",
                                 not_there, "), in ", counted(facts.groups.size(), "group"))},
              {"dimension", name_of(volume.info.dimension)},
              {"cells", str_cat(cells_text(volume), ", ",
                                counted(volume.cells.size() - inner, "hull cell"))}};
    if (facts.slivers) {
        const auto [below_1e3, below_1e6] = *facts.slivers;
        rows.push_back({"slivers", str_cat(grouped(below_1e3), " of quality < 1e-3 (",
                                           percent(below_1e3, inner), "), ", grouped(below_1e6),
                                           " < 1e-6 (", percent(below_1e6, inner), ")")});
    }
    if (facts.walks) std::ranges::copy(walk_rows(facts), std::back_inserter(rows));
    if (!facts.bounds.is_null()) {
        rows.push_back({"bounds", str_cat(corner_text(facts.bounds["min"]), "  to  ",
                                          corner_text(facts.bounds["max"]))});
    }
    rows.push_back({"walls", walls_text(facts, volume.cells.size())});
    rows.push_back({"unseen", facts.walls ? to_text(facts.walls->unseen) : "not known"});
    rows.push_back({"light", facts.is_baked ? "baked" : "none (not baked)"});
    rows.push_back({"lights", lights_text(facts.lights)});
    if (facts.noise.probe_count > 0) rows.push_back({"noise", to_text(facts.noise)});
    rows.push_back({"layers", layers_text(facts)});
    const auto names = split_names(volume.layer_names);
    const auto noise = layer_noise(volume);
    for (size_t i = 0; i < std::min(names.size(), noise.size()); ++i) {
        rows.push_back({"  " + printable(std::string(names[i])), to_text(noise[i])});
    }
    if (!facts.rendering_layers.is_null()) {
        rows.push_back({"rendering layers", rendering_layers_text(facts.rendering_layers)});
    }
    if (facts.made_with.is_object()) rows.push_back({"made with", made_with_text(facts.made_with)});
    return rows;
}

Rows group_rows(const VolumeFacts& facts, size_t source_count) {
    Rows rows;
    for (const Json& group : facts.groups) {
        const uint64_t probes = group["probes"], left_out = group["left_out"];
        rows.push_back({name_text(group["name"]), grouped(probes), percent(probes, source_count),
                        left_out > 0 ? grouped(left_out) + " left out" : ""});
    }
    return rows;
}

Rows memory_rows(const VolumeFacts& facts) {
    const uint64_t bytes = facts.bytes();
    const uint64_t probes = facts.counts["probes"];
    const auto each = [&](uint64_t sum) {
        return probes == 0 ? "" : grouped((sum + probes / 2) / probes) + " B a probe";
    };
    std::vector<SectionFacts> sections = facts.sections;
    std::ranges::stable_sort(sections, [](const SectionFacts& a, const SectionFacts& b) {
        return a.is_resident != b.is_resident ? a.is_resident : a.bytes > b.bytes;
    });
    Rows rows;
    for (const SectionFacts& section : sections) {
        rows.push_back({printable(section.name), bytes_text(section.bytes),
                        percent(section.bytes, bytes), section.is_resident ? "resident" : "cold"});
    }
    const uint64_t resident = facts.resident_bytes();
    rows.push_back(
        {"read by queries", bytes_text(resident), percent(resident, bytes), each(resident)});
    rows.push_back({"all", bytes_text(bytes), percent(bytes, bytes), each(bytes)});
    return rows;
}

}  // namespace

std::string to_text(const VolumeFacts& facts, const ProbeVolumeView& volume) {
    std::string lines = str_cat(printable(facts.path), "\n", aligned(summary(facts, volume), "ll"));
    if (!facts.groups.empty()) {
        lines += "probes by group\n" +
                 aligned(group_rows(facts, volume.sources.size() - left_out_count(volume)), "lrrl");
    }
    lines += "memory by section\n" + aligned(memory_rows(facts), "lrrl");
    lines.pop_back();
    return lines;
}

}  // namespace tetralight::cli
