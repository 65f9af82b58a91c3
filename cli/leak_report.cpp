// SPDX-License-Identifier: Apache-2.0
#include <tetralight/cli/leak_report.h>

#include <cstdio>

#include <tetralight/base/str_cat.h>
#include <tetralight/cli/table.h>
#include <tetralight/cli/walls_report.h>

namespace tetralight::cli {
namespace {

Json leak_part_json(const LeakPart& part) {
    return {{"mean", part.mean}, {"p95", part.p95}};
}

Json leak_place_json(const LeakPlace& place) {
    return {{"position", to_json(place.position)},
            {"is_unseen", place.is_unseen},
            {"through_walls", place.through_walls()},
            {"missing", place.missing()},
            {"answer", place.answer},
            {"traced", place.traced}};
}

std::string light_text(double light) {
    char buffer[64];
    std::snprintf(buffer, sizeof buffer, "%.4g", light);
    return buffer;
}

std::vector<std::string> row(const char* name, const LeakPart& part) {
    return {name, share_text(part.mean), share_text(part.p95)};
}

std::vector<std::string> row(const char* name, const LeakPart& part, const LeakPart& plain) {
    auto cells = row(name, part);
    cells.insert(cells.end(), {share_text(plain.mean), share_text(plain.p95)});
    return cells;
}

std::string parts_text(const LeakReport& report) {
    return aligned({{"of the mean light", "mean", "p95", "without walls: mean", "p95"},
                    row("  through walls", report.through_walls, report.plain_through_walls),
                    row("  missing", report.missing, report.plain_missing),
                    row("  rest", report.rest),
                    {"  noise in the rest", share_text(report.noise)}},
                   "lrrrr");
}

std::string worst_text(const LeakReport& report) {
    std::vector<std::vector<std::string>> rows{
        {"most light through walls at", "through walls", "answer", "traced"}};
    for (const uint32_t i : report.worst_places()) {
        const LeakPlace& place = report.places[i];
        rows.push_back({"  " + position_text(place.position), light_text(place.through_walls()),
                        light_text(place.answer), light_text(place.traced)});
    }
    return rows.size() == 1 ? "" : aligned(rows, "lrrr");
}

}  // namespace

Json to_json(const LeakReport& report) {
    Json worst = Json::array();
    for (const uint32_t i : report.worst_places())
        worst.push_back(leak_place_json(report.places[i]));
    return {{"places", report.places.size()},
            {"unseen", report.unseen_count},
            {"mean_light", report.mean_light},
            {"through_walls", leak_part_json(report.through_walls)},
            {"missing", leak_part_json(report.missing)},
            {"rest", leak_part_json(report.rest)},
            {"noise", report.noise},
            {"without_walls",
             {{"through_walls", leak_part_json(report.plain_through_walls)},
              {"missing", leak_part_json(report.plain_missing)}}},
            {"worst", worst}};
}

Json all_places_json(const LeakReport& report) {
    Json places = Json::array();
    for (const LeakPlace& place : report.places) places.push_back(leak_place_json(place));
    return places;
}

std::string to_text(const LeakReport& report) {
    std::string lines =
        str_cat("light at ", counted(report.places.size(), "free place"), ", ",
                grouped(report.unseen_count), " of them see no probe of their cell; mean light ",
                light_text(report.mean_light), "\n", parts_text(report), worst_text(report));
    lines.pop_back();
    return lines;
}

std::string share_text(double share) {
    char buffer[64];
    const double percent = 100.0 * share;
    const char* format = percent >= 10.0 ? "%.1f %%" : percent >= 0.1 ? "%.2f %%" : "%.4f %%";
    std::snprintf(buffer, sizeof buffer, percent == 0.0 ? "0 %%" : format, percent);
    return buffer;
}

}  // namespace tetralight::cli
