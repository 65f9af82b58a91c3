// SPDX-License-Identifier: Apache-2.0
#include <charconv>
#include <fstream>
#include <iostream>

#include "base/text.h"
#include "cli/common.h"
#include "cli/paths.h"
#include "probes/interpolate.h"
#include "probes/probe_file.h"

namespace tetralight::cli {
namespace {

/// Three numbers with blanks or commas between them.
std::optional<glm::vec3> parse_position(std::string_view line) {
    glm::vec3 position(0.0f);
    const auto is_gap = [](char c) { return c == ' ' || c == '\t' || c == ',' || c == '\r'; };
    const auto skip_gap = [&] {
        while (!line.empty() && is_gap(line.front())) line.remove_prefix(1);
    };
    for (int axis = 0; axis < 3; ++axis) {
        skip_gap();
        const char* const end = line.data() + line.size();
        const auto [next, error] = std::from_chars(line.data(), end, position[axis]);
        if (error != std::errc{}) return std::nullopt;
        line.remove_prefix(static_cast<size_t>(next - line.data()));
    }
    skip_gap();
    return line.empty() ? std::optional(position) : std::nullopt;
}

/// A line as messages show it: not too long.
std::string shown(const std::string& line) {
    constexpr size_t kLongest = 40;
    return line.size() > kLongest ? line.substr(0, kLongest) + "..." : line;
}

struct Answer {
    glm::vec3 position;
    CellLocation location;
    InterpolatedProbe light;
};

Json to_json(const Answer& answer, const ProbeVolumeView& volume) {
    Json probes = Json::array();
    if (answer.location.cell < volume.cells.size()) {
        for (int i = 0; i < 4; ++i) {
            const uint32_t probe = volume.cells[answer.location.cell].vertices[i];
            if (probe == kNoIndex) continue;
            probes.push_back({{"probe", probe}, {"weight", answer.location.weights[i]}});
        }
    }
    Json sh = Json::array();
    for (const glm::vec3& c : answer.light.irradiance.coefficients) sh.push_back({c.x, c.y, c.z});
    const glm::vec4& o = answer.light.occlusion;
    Json json{{"position", {answer.position.x, answer.position.y, answer.position.z}}};
    json["cell"] = answer.location.cell == kNoIndex ? Json() : Json(answer.location.cell);
    json.update({{"probes", probes}, {"irradiance_sh", sh}, {"occlusion", {o.x, o.y, o.z, o.w}}});
    return json;
}

std::string to_text(const Answer& answer, const ProbeVolumeView& volume) {
    std::string line = text(answer.position.x, " ", answer.position.y, " ", answer.position.z);
    if (answer.location.cell >= volume.cells.size()) return line + ": ambient";
    const bool is_outside = answer.location.cell >= volume.info.inner_cell_count;
    line +=
        text(": ", is_outside ? "hull cell " : "tetrahedron ", answer.location.cell, ", probes");
    for (int i = 0; i < 4; ++i) {
        const uint32_t probe = volume.cells[answer.location.cell].vertices[i];
        if (probe != kNoIndex) line += text(" ", probe, "×", answer.location.weights[i]);
    }
    const glm::vec3 up = evaluate_irradiance(answer.light.irradiance, {0.0f, 1.0f, 0.0f});
    return line + text(", irradiance from above ", up.x, " ", up.y, " ", up.z);
}

struct Query {
    std::string volume_path;
    std::string positions_path = "-";
    CommonOptions common;

    void add_to(CLI::App& command) {
        add_path(command, "VOLUME", volume_path, "Probe volume (.probes)")->required();
        command
            .add_option("POSITIONS", positions_path,
                        "Text file with x y z a line (# begins a comment); - = stdin")
            ->capture_default_str();
        common.add_to(command);
    }

    Status run() {
        const auto file = open_probe_file(volume_path);
        if (!file) return file.error();
        if (positions_path == "-") return answer_lines(std::cin, file->view());
        std::ifstream stream(positions_path);
        if (!stream) return Error{positions_path + ": cannot open"};
        return answer_lines(stream, file->view());
    }

    [[nodiscard]] std::string positions_name() const {
        return positions_path == "-" ? "stdin" : positions_path;
    }

    Status answer_lines(std::istream& stream, const ProbeVolumeView& volume) const {
        std::string line;
        uint32_t hint = kNoIndex;
        for (size_t number = 1; std::getline(stream, line); ++number) {
            line.resize(std::min(line.find('#'), line.size()));
            if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
            const auto position = parse_position(line);
            if (!position) {
                return Error{
                    text(positions_name(), ":", number, ": \"", shown(line), "\" is not x y z")};
            }
            const CellLocation location = locate(volume, *position, hint);
            const Answer answer{*position, location, interpolate(volume, location)};
            hint = location.cell;
            if (common.is_json) {
                std::cout << dump(to_json(answer, volume)) << '\n';
            } else {
                std::cout << to_text(answer, volume) << '\n';
            }
        }
        if (stream.bad()) return Error{positions_name() + ": cannot read"};
        return Ok{};
    }
};

}  // namespace

void add_query(CLI::App& app, Run& run) {
    add_command<Query>(app, run, "query", "Say what light arrives at positions",
                       "echo 0 1 0 | tetralight query courtyard.probes --json");
}

}  // namespace tetralight::cli
