// SPDX-License-Identifier: Apache-2.0
#include <tetralight/cli/answer.h>

#include <charconv>

#include <tetralight/base/str_cat.h>
#include <tetralight/cli/common.h>
#include <tetralight/probes/answer_json.h>

namespace tetralight::cli {
namespace {

constexpr int kCoefficientCount = 9;

/// The shortest digits that read back to the same number.
template <class Number>
void append_number(std::string& out, Number number) {
    char digits[32];
    out.append(digits, std::to_chars(digits, digits + sizeof digits, number).ptr);
}

/// Calls `visit(probe, weight)` for the probes of a location.
template <class Visit>
void for_each_probe(const CellLocation& location, const Cell& cell, Visit visit) {
    for (int i = 0; i < 4; ++i) {
        const uint32_t probe = cell.vertices[static_cast<size_t>(i)];
        if (probe != kNoIndex) visit(probe, location.weights[i]);
    }
}

}  // namespace

AnswerCell answer_cell(const ProbeVolumeView& volume, uint32_t cell) {
    if (cell >= volume.cells.size()) return {};
    return {&volume.cells[cell], cell >= volume.info.inner_cell_count, volume.info.dimension};
}

void append_text(std::string& out, const glm::vec3& position, const CellLocation& location,
                 const RawAnswer& answer, const AnswerCell& cell) {
    out += str_cat(position.x, " ", position.y, " ", position.z);
    if (cell.cell == nullptr) {
        out += ": ambient\n";
        return;
    }
    out += str_cat(": ", cell.is_hull_cell ? "hull cell" : cell_name(cell.dimension), " ",
                   location.cell, ", probes");
    for_each_probe(location, *cell.cell,
                   [&](uint32_t probe, float weight) { out += str_cat(" ", probe, "×", weight); });
    if (location.ambient > 0.0f) out += str_cat(", ambient×", location.ambient);
    const glm::vec3 up = evaluate_irradiance(answer.irradiance, {0.0f, 1.0f, 0.0f});
    out += str_cat(", irradiance from above ", up.x, " ", up.y, " ", up.z, "\n");
}

void append_json(std::string& out, const glm::vec3& position, const CellLocation& location,
                 const RawAnswer& answer, const AnswerCell& cell) {
    char line[kAnswerJsonSize];
    char* end =
        write_json(line, cell.cell, {position, location, answer.irradiance, answer.occlusion});
    *end++ = '\n';
    out.append(line, end);
}

void append_csv(std::string& out, const glm::vec3& position, const RawAnswer& answer) {
    for (int i = 0; i < 3; ++i) {
        append_number(out, position[i]);
        out += ',';
    }
    if (answer.cell != kNoIndex) append_number(out, answer.cell);
    for (const glm::vec3& coefficient : answer.irradiance.coefficients) {
        for (int i = 0; i < 3; ++i) {
            out += ',';
            append_number(out, coefficient[i]);
        }
    }
    for (int i = 0; i < 4; ++i) {
        out += ',';
        append_number(out, answer.occlusion[i]);
    }
    out += '\n';
}

std::string csv_header() {
    std::string header = "x,y,z,cell";
    for (int i = 0; i < kCoefficientCount; ++i) {
        for (const char channel : {'r', 'g', 'b'}) header += str_cat(",sh", i, "_", channel);
    }
    for (int i = 0; i < 4; ++i) header += str_cat(",occlusion", i);
    return header + "\n";
}

}  // namespace tetralight::cli
