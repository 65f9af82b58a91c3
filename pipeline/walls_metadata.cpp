// SPDX-License-Identifier: Apache-2.0
#include <tetralight/pipeline/walls_metadata.h>

#include <nlohmann/json.hpp>

#include <tetralight/base/json/json_text.h>
#include <tetralight/probes/build/store_visibility.h>

namespace tetralight {
namespace {

using Json = nlohmann::ordered_json;

Json positions_json(const std::vector<glm::dvec3>& positions) {
    Json json = Json::array();
    for (const glm::dvec3& position : positions) {
        json.push_back({position.x, position.y, position.z});
    }
    return json;
}

bool read(const Json& json, const char* name, uint64_t& count) {
    const auto found = json.find(name);
    if (found == json.end() || !found->is_number_unsigned()) return false;
    count = found->get<uint64_t>();
    return true;
}

bool read(const Json& json, const char* name, std::vector<glm::dvec3>& positions) {
    const auto found = json.find(name);
    if (found == json.end() || !found->is_array()) return false;
    for (const Json& position : *found) {
        const bool is_position = position.is_array() && position.size() == 3 &&
                                 position[0].is_number() && position[1].is_number() &&
                                 position[2].is_number();
        if (!is_position) return false;
        positions.emplace_back(position[0].get<double>(), position[1].get<double>(),
                               position[2].get<double>());
    }
    return true;
}

}  // namespace

std::string add_walls(std::string_view metadata, const WallsMetadata& walls) {
    Json json = Json::parse(metadata);
    json["walls"] = {{"edges", walls.edge_count},
                     {"blocked_edges", walls.blocked_edge_count},
                     {"marked_cells", walls.marked_cell_count},
                     {"unclear_cells", walls.unclear_cell_count},
                     {"left_out_probes", walls.left_out_count},
                     {"free_places", walls.unseen.place_count},
                     {"unseen_places", walls.unseen.unseen_count},
                     {"unseen", positions_json(walls.unseen.positions)}};
    return json.dump();
}

std::optional<WallsMetadata> read_walls(std::string_view metadata) {
    if (!check_json_object(metadata)) return std::nullopt;
    const Json json = Json::parse(metadata);
    const auto found = json.find("walls");
    if (found == json.end() || !found->is_object()) return std::nullopt;
    WallsMetadata walls;
    const bool is_read = read(*found, "unclear_cells", walls.unclear_cell_count) &&
                         read(*found, "left_out_probes", walls.left_out_count) &&
                         read(*found, "free_places", walls.unseen.place_count) &&
                         read(*found, "unseen_places", walls.unseen.unseen_count) &&
                         read(*found, "unseen", walls.unseen.positions);
    if (!is_read) return std::nullopt;
    const bool has_edges = read(*found, "edges", walls.edge_count) &&
                           read(*found, "blocked_edges", walls.blocked_edge_count) &&
                           read(*found, "marked_cells", walls.marked_cell_count);
    if (!has_edges) walls.edge_count = 0;
    return walls;
}

VisibilityReport stored_visibility(const ProbeVolumeView& volume) {
    VisibilityReport report;
    if (volume.visibility_blocks.empty()) return report;
    const auto walls = read_walls(volume.metadata);
    if (walls) {
        report.edge_count = walls->edge_count;
        report.blocked_edge_count = walls->blocked_edge_count;
        report.marked_cell_count = walls->marked_cell_count;
        report.unclear_cell_count = walls->unclear_cell_count;
        report.left_out_count = walls->left_out_count;
    }
    if (report.edge_count > 0) return report;
    const VisibilityFacts facts = visibility_facts(volume);
    report.edge_count = facts.edges;
    report.blocked_edge_count = facts.blocked_edges;
    report.marked_cell_count = facts.marked_cells;
    return report;
}

}  // namespace tetralight
