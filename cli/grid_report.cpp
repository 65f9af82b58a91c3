// SPDX-License-Identifier: Apache-2.0
#include <tetralight/cli/grid_report.h>

#include <algorithm>
#include <array>
#include <limits>

#include <tetralight/base/str_cat.h>
#include <tetralight/cli/amounts.h>
#include <tetralight/cli/table.h>

namespace tetralight::cli {
namespace {

struct Reason {
    Fate fate;
    const char* key;
    const char* words;
};

constexpr Reason kReasons[] = {{Fate::Inside, "inside_geometry", "inside geometry"},
                               {Fate::TooClose, "too_close", "too close to a surface"},
                               {Fate::Unreachable, "unreachable", "unreachable"},
                               {Fate::Forbidden, "forbidden", "forbidden by a volume"},
                               {Fate::Crowded, "crowded", "beside another probe"},
                               {Fate::Redundant, "spared", "light is as good without"}};

/// Upper ends of the histogram's bins, metres.
constexpr std::array<float, 8> kEnds{0.05f, 0.1f, 0.25f, 0.5f,
                                     1.0f,  2.0f, 4.0f,  std::numeric_limits<float>::infinity()};

std::array<uint64_t, kEnds.size()> histogram(const ProbeGrid& grid) {
    std::array<uint64_t, kEnds.size()> counts{};
    for (const float distance : grid.surface_distances) {
        // Probes at the clearance may be short of it by rounding.
        constexpr float kSlack = 1.002f;
        const auto end = std::ranges::upper_bound(kEnds, kSlack * distance);
        ++counts[std::min<size_t>(end - kEnds.begin(), kEnds.size() - 1)];
    }
    return counts;
}

std::string bin_name(size_t bin) {
    const float low = bin == 0 ? 0.0f : kEnds[bin - 1];
    return bin + 1 == kEnds.size() ? str_cat("from ", low, " m on")
                                   : str_cat(low, " to ", kEnds[bin], " m");
}

std::string bar(uint64_t count, uint64_t most) {
    constexpr uint64_t kWidth = 32;
    return std::string((count * kWidth + most - 1) / most, '#');
}

std::string histogram_text(const ProbeGrid& grid) {
    const auto counts = histogram(grid);
    const uint64_t most = std::max<uint64_t>(1, *std::ranges::max_element(counts));
    std::vector<std::vector<std::string>> rows;
    for (size_t i = 0; i < counts.size(); ++i) {
        rows.push_back({bin_name(i), grouped(counts[i]), bar(counts[i], most)});
    }
    return "to the nearest surface:\n" + aligned(rows, "lrl");
}

Json adaptive_json(const AdaptiveReport& report) {
    return {{"error", report.error},
            {"end", name_of(report.end)},
            {"rounds", report.round_count},
            {"start_spacing", to_json(report.start_spacing)},
            {"start_probes", report.start_probe_count},
            {"most_probes", report.peak_probe_count},
            {"sampled_positions", report.position_count},
            {"samples", report.sample_count},
            {"rays", report.ray_count}};
}

std::string adaptive_text(const AdaptiveReport& report) {
    return str_cat("error ", percent(report.error), " (", name_of(report.end), ") after ",
                   counted(report.round_count, "round"), ", by the light of ",
                   counted(report.position_count, "position"), " with ",
                   counted(report.sample_count, "sample"), " each, ",
                   magnitude(static_cast<double>(report.ray_count)), "rays\n");
}

std::string fraction_text(uint64_t count, uint64_t all) {
    return all == 0 ? "" : percent(static_cast<double>(count) / static_cast<double>(all));
}

/// With as few digits as needed.
std::string place_text(const glm::dvec3& position) {
    const glm::vec3 p(position);
    return str_cat(p.x, ",", p.y, ",", p.z);
}

constexpr size_t kMostLines = 3;

void add_pockets(const ProbeGrid& grid, std::vector<std::string>& lines) {
    for (size_t i = 0; i < std::min(grid.dropped_spaces.size(), kMostLines); ++i) {
        const uint64_t count = grid.dropped_spaces[i].probe_count;
        const std::string place = place_text(grid.dropped_spaces[i].position);
        lines.push_back(str_cat(counted(count, "probe"), " around ", place,
                                " cannot be reached and ", count == 1 ? "was" : "were",
                                " dropped; --from ", place, " would keep them"));
    }
    if (grid.dropped_spaces.size() > kMostLines) {
        lines.push_back(str_cat("and ", grid.dropped_spaces.size() - kMostLines,
                                " smaller spaces; --unreachable keep keeps all"));
    }
}

void add_empty_spaces(const ProbeGrid& grid, std::vector<std::string>& lines) {
    for (size_t i = 0; i < std::min(grid.empty_spaces.size(), kMostLines); ++i) {
        const EmptySpace& space = grid.empty_spaces[i];
        const std::string place = place_text(space.position);
        lines.push_back(str_cat("the space around ", place, " has no probes; ",
                                space.is_wanted ? "a smaller --spacing would give it some"
                                                : "--from " + place + " would ask for some"));
    }
    if (grid.empty_spaces.size() > kMostLines) {
        lines.push_back(
            str_cat("and ", grid.empty_spaces.size() - kMostLines, " more spaces have no probes"));
    }
}

}  // namespace

Json grid_json(const std::string& output, const ProbeGrid& grid) {
    Json json{{"output", output},
              {"probes", grid.probe_count()},
              {"groups", grid.groups.size()},
              {"candidates", grid.candidate_count},
              {"kept_in_place", grid.count(Fate::Kept)},
              {"pushed", grid.count(Fate::Pushed)}};
    for (const Reason& reason : kReasons) json[reason.key] = grid.count(reason.fate);
    Json pockets = Json::array();
    for (const DroppedSpace& pocket : grid.dropped_spaces) {
        pockets.push_back({{"probes", pocket.probe_count}, {"position", to_json(pocket.position)}});
    }
    json["pockets"] = pockets;
    Json empty = Json::array();
    for (const EmptySpace& space : grid.empty_spaces) {
        empty.push_back({{"position", to_json(space.position)}, {"is_wanted", space.is_wanted}});
    }
    json["empty_spaces"] = empty;
    Json bins = Json::array();
    const auto counts = histogram(grid);
    for (size_t i = 0; i < counts.size(); ++i) {
        Json bin{{"from", i == 0 ? 0.0f : kEnds[i - 1]}};
        if (i + 1 < kEnds.size()) bin["to"] = kEnds[i];
        bin["probes"] = counts[i];
        bins.push_back(bin);
    }
    json["surface_distance"] = bins;
    if (grid.adaptive) json["adaptive"] = adaptive_json(*grid.adaptive);
    return json;
}

std::string grid_text(const std::string& output, const ProbeGrid& grid) {
    std::vector<std::vector<std::string>> rows;
    const auto add = [&](const std::string& words, uint64_t count) {
        rows.push_back({words, grouped(count), fraction_text(count, grid.candidate_count)});
    };
    add("kept where it stood", grid.count(Fate::Kept));
    add("pushed", grid.count(Fate::Pushed));
    for (const Reason& reason : kReasons) {
        if (grid.count(reason.fate) > 0)
            add(str_cat("dropped: ", reason.words), grid.count(reason.fate));
    }
    return str_cat(output, ": ", counted(grid.probe_count(), "probe"), " in ",
                   counted(grid.groups.size(), "group"), ", of ",
                   counted(grid.candidate_count, "candidate"), "\n",
                   grid.adaptive ? adaptive_text(*grid.adaptive) : "", aligned(rows, "lrr"),
                   histogram_text(grid));
}

std::vector<std::string> grid_warnings(const ProbeGrid& grid, const ProbeGridSettings& settings) {
    std::vector<std::string> lines;
    add_pockets(grid, lines);
    add_empty_spaces(grid, lines);
    for (const std::string& name : grid.adjustments_outside) {
        lines.push_back(
            str_cat("adjustment volume \"", name, "\" lies outside of the box to fill"));
    }
    const auto& asked = settings.adaptive.start_spacing;
    if (grid.adaptive && asked && grid.adaptive->start_spacing != *asked) {
        lines.push_back(
            str_cat("--spacing ", place_text(*asked),
                    " asks for more than half of the most probes to begin with; it began "
                    "with ",
                    place_text(grid.adaptive->start_spacing)));
    }
    return lines;
}

}  // namespace tetralight::cli
