// SPDX-License-Identifier: Apache-2.0
#include <tetralight/cli/grid_report.h>

#include <algorithm>
#include <array>
#include <cmath>
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
                               {Fate::Dark, "without_light", "without light"},
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
                   counted(report.position_count, "position"), ", ",
                   magnitude(static_cast<double>(report.sample_count)), "samples, ",
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

const char* name_of(SpaceFate fate) {
    constexpr const char* kNames[] = {"filled", "unreachable", "without light"};
    return kNames[static_cast<size_t>(fate)];
}

const char* light_of(const Space& space) {
    if (space.light.has_sky) return space.light.has_lights ? "sky, lights" : "sky";
    return space.light.has_lights ? "lights" : "none";
}

/// A number of cubic metres with few digits.
std::string volume_text(double volume) {
    return str_cat(grouped(static_cast<uint64_t>(std::llround(volume))), " m3");
}

std::string spaces_text(const ProbeGrid& grid) {
    if (grid.spaces.size() < 2) return "";
    constexpr size_t kMostSpaces = 8;
    std::vector<std::vector<std::string>> rows{{"around", "room", "probes", "light", "", ""}};
    for (size_t i = 0; i < std::min(grid.spaces.size(), kMostSpaces); ++i) {
        const Space& space = grid.spaces[i];
        rows.push_back({place_text(space.position), volume_text(space.volume),
                        grouped(space.probe_count), light_of(space), name_of(space.fate),
                        space.has_seed ? "--from" : ""});
    }
    std::string more;
    if (grid.spaces.size() > kMostSpaces) {
        more = str_cat("  and ", grid.spaces.size() - kMostSpaces, " smaller ones\n");
    }
    return "spaces:\n" + aligned(rows, "lrrlll") + more;
}

std::string coverage_text(const ProbeGrid& grid) {
    const Coverage& coverage = grid.coverage;
    if (coverage.place_count() == 0) return "";
    std::vector<std::vector<std::string>> rows;
    const auto add = [&](const char* words, Cover cover) {
        rows.push_back({words, percent(coverage.share(cover))});
    };
    add("covered", Cover::Covered);
    add("outside of the tetrahedra", Cover::HullCell);
    add("out of sight of probes", Cover::Unseen);
    return "free space:\n" + aligned(rows, "lr");
}

void add_left_out(const ProbeGrid& grid, std::vector<std::string>& lines) {
    uint64_t count = 0, smaller_count = 0;
    for (const Space& space : grid.spaces) {
        if (space.fate == SpaceFate::Filled || space.probe_count == 0) continue;
        if (++count > kMostLines) {
            ++smaller_count;
            continue;
        }
        const std::string place = place_text(space.position);
        const bool is_dark = space.fate == SpaceFate::Dark;
        lines.push_back(str_cat(counted(space.probe_count, "probe"), " around ", place,
                                is_dark ? " would get no light and " : " cannot be reached and ",
                                space.probe_count == 1 ? "was" : "were", " dropped; ",
                                is_dark ? "--keep-dark or --from " : "--from ", place,
                                " would keep them"));
    }
    if (smaller_count > 0) {
        lines.push_back(str_cat("and ", smaller_count,
                                " smaller spaces; --unreachable keep --keep-dark keeps all"));
    }
}

void add_empty_spaces(const ProbeGrid& grid, std::vector<std::string>& lines) {
    uint64_t count = 0;
    for (const Space& space : grid.spaces) {
        if (space.probe_count > 0 || space.fate == SpaceFate::Dark) continue;
        if (++count > kMostLines) continue;
        const std::string place = place_text(space.position);
        lines.push_back(
            str_cat("the space around ", place, " has no probes; ",
                    space.fate == SpaceFate::Filled
                        ? "more --max-probes or a smaller --clearance would give it some"
                        : "--from " + place + " would ask for some"));
    }
    if (count > kMostLines) {
        lines.push_back(str_cat("and ", count - kMostLines, " more spaces have no probes"));
    }
}

void add_darkness(const ProbeGrid& grid, std::vector<std::string>& lines) {
    const bool is_lit =
        std::ranges::any_of(grid.spaces, [](const Space& space) { return !space.light.is_dark(); });
    if (!is_lit) lines.emplace_back("no light of the scene reaches any space; add one with --sky");
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
    json["added"] = grid.count(Fate::Added);
    Json spaces = Json::array();
    for (const Space& space : grid.spaces) {
        spaces.push_back({{"position", to_json(space.position)},
                          {"volume", space.volume},
                          {"probes", space.probe_count},
                          {"sky", space.light.has_sky},
                          {"lights", space.light.has_lights},
                          {"from", space.has_seed},
                          {"fate", name_of(space.fate)}});
    }
    json["spaces"] = spaces;
    json["coverage"] = {{"places", grid.coverage.place_count()},
                        {"covered", grid.coverage.share(Cover::Covered)},
                        {"outside", grid.coverage.share(Cover::HullCell)},
                        {"unseen", grid.coverage.share(Cover::Unseen)}};
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
    add("pushed, or taken to a wall", grid.count(Fate::Pushed));
    add("added at walls and out of sight", grid.count(Fate::Added));
    for (const Reason& reason : kReasons) {
        if (grid.count(reason.fate) > 0)
            add(str_cat("dropped: ", reason.words), grid.count(reason.fate));
    }
    return str_cat(output, ": ", counted(grid.probe_count(), "probe"), " in ",
                   counted(grid.groups.size(), "group"), ", of ",
                   counted(grid.candidate_count, "candidate"), "\n",
                   grid.adaptive ? adaptive_text(*grid.adaptive) : "", aligned(rows, "lrr"),
                   coverage_text(grid), spaces_text(grid), histogram_text(grid));
}

std::vector<std::string> grid_warnings(const ProbeGrid& grid, const ProbeGridSettings& settings) {
    std::vector<std::string> lines;
    add_left_out(grid, lines);
    add_empty_spaces(grid, lines);
    add_darkness(grid, lines);
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
