// SPDX-License-Identifier: Apache-2.0
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iostream>

#include "base/text.h"
#include "cli/common.h"
#include "cli/paths.h"
#include "probes/interpolate.h"
#include "probes/probe_file.h"

namespace tetralight::cli {
namespace {

/// A line as messages show it: not too long.
std::string shown(std::string_view line) {
    constexpr size_t kLongest = 40;
    return std::string(line.substr(0, kLongest)) + (line.size() > kLongest ? "..." : "");
}

/// Takes a number from the front of a line.
Result<float> take_number(std::string_view& line, char axis) {
    float number = 0.0f;
    const auto [next, error] = std::from_chars(line.data(), line.data() + line.size(), number);
    if (error == std::errc::invalid_argument) return Error{};
    const std::string digits(line.data(), next);
    if (error == std::errc::result_out_of_range) {
        const double value = std::strtod(digits.c_str(), nullptr);
        if (std::abs(value) > 1.0) {
            return Error{text(axis, " is ", shown(digits), ", beyond what a float holds (3.4e38)")};
        }
        number = static_cast<float>(value);  // nearly 0
    }
    line.remove_prefix(digits.size());
    return number;
}

/// Three numbers with blanks or commas between them.
Result<glm::vec3> parse_position(const std::string& whole) {
    constexpr const char* kGaps = " \t,\r";
    std::string_view line = whole;
    const auto skip_gap = [&] {
        line.remove_prefix(std::min(line.find_first_not_of(kGaps), line.size()));
    };
    const Error not_three{text("\"", shown(whole), "\" is not x y z")};
    glm::vec3 position(0.0f);
    for (int axis = 0; axis < 3; ++axis) {
        skip_gap();
        const auto number = take_number(line, "xyz"[axis]);
        if (!number) return number.error().message.empty() ? not_three : number.error();
        position[axis] = *number;
    }
    skip_gap();
    if (!line.empty()) return not_three;
    return position;
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
        add_path(command, "POSITIONS", positions_path,
                 "Text file with x y z a line (# begins a comment); - = stdin")
            ->capture_default_str();
        common.add_to(command);
    }

    Status run() {
        const auto file = open_probe_file(volume_path);
        if (!file) return file.error();
        common.warn_if_unlit(volume_path, file->view());
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
            if (!position) return position.error().in(text(positions_name(), ":", number));
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
