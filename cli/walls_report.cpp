// SPDX-License-Identifier: Apache-2.0
#include <tetralight/cli/walls_report.h>

#include <algorithm>
#include <cmath>

#include <tetralight/base/str_cat.h>
#include <tetralight/cli/amounts.h>

namespace tetralight::cli {

Json to_json(const VisibilityReport& walls) {
    if (walls.edge_count == 0) return nullptr;
    Json json{{"edges", walls.edge_count},
              {"blocked_edges", walls.blocked_edge_count},
              {"marked_cells", walls.marked_cell_count},
              {"unclear_cells", walls.unclear_cell_count},
              {"left_out_probes", walls.left_out_count}};
    if (walls.ray_count > 0) json["rays"] = walls.ray_count;
    return json;
}

std::string to_text(const VisibilityReport& walls) {
    if (walls.edge_count == 0) return "";
    return str_cat("walls block ", grouped(walls.blocked_edge_count), " of ",
                   counted(walls.edge_count, "edge"), "; ",
                   counted(walls.unclear_cell_count, "cell"),
                   " with surfaces that edges do not show",
                   walls.left_out_count > 0 ? str_cat("; ", counted(walls.left_out_count, "probe"),
                                                      " moved through a wall, which nothing hides")
                                            : "");
}

Json to_json(const UnseenPlaces& unseen) {
    if (unseen.place_count == 0) return nullptr;
    Json positions = Json::array();
    for (const glm::dvec3& position : unseen.positions) positions.push_back(to_json(position));
    return {{"places", unseen.place_count},
            {"unseen", unseen.unseen_count},
            {"share", unseen.share()},
            {"positions", positions}};
}

std::string to_text(const UnseenPlaces& unseen) {
    if (unseen.place_count == 0) return "no free space was found around the probes";
    std::string line = str_cat(percent(unseen.share()), " of free space sees no probe of its cell");
    constexpr size_t kMostShown = 3;
    for (size_t i = 0; i < std::min(unseen.positions.size(), kMostShown); ++i) {
        line += (i == 0 ? ", for example at " : ", ") + position_text(unseen.positions[i]);
    }
    return line;
}

std::string walls_text(const BakeReport& report) {
    const VisibilityReport& walls = report.visibility;
    const auto line = [](const std::string& text, double seconds) {
        return str_cat("\n  ", text, seconds > 0.0 ? str_cat(" (", duration(seconds), ")") : "");
    };
    std::string lines;
    if (walls.edge_count > 0) lines += line(to_text(walls), walls.seconds);
    const bool has_probes = walls.edge_count > 0 || report.unseen.place_count > 0;
    if (has_probes) lines += line(to_text(report.unseen), report.unseen_seconds);
    return lines;
}

std::string position_text(const glm::dvec3& position) {
    const auto rounded = [](double metres) { return std::round(metres * 1000.0) / 1000.0 + 0.0; };
    return str_cat("(", rounded(position.x), ", ", rounded(position.y), ", ", rounded(position.z),
                   ")");
}

}  // namespace tetralight::cli
