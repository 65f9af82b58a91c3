// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <string>
#include <type_traits>

#include <tetralight/probes/locate.h>
#include <tetralight/probes/probe_volume.h>

// The answers of `query` and the forms in which they are written; docs/query.md describes them.

namespace tetralight::cli {

/// An answer as raw output has it.
struct RawAnswer {
    IrradianceSh irradiance;
    glm::vec4 occlusion{1.0f};
    uint32_t cell = kNoIndex;

    bool operator==(const RawAnswer&) const = default;
};

static_assert(sizeof(RawAnswer) == 128 && std::is_trivially_copyable_v<RawAnswer>);

/// The cell that gave an answer.
struct AnswerCell {
    const Cell* cell = nullptr;  ///< null: none
    bool is_hull_cell = false;
    Dimension dimension = Dimension::None;
};

[[nodiscard]] AnswerCell answer_cell(const ProbeVolumeView& volume, uint32_t cell);

/// Appends a line for people: the cell, its probes with their weights, the light from above.
void append_text(std::string& out, const glm::vec3& position, const CellLocation& location,
                 const RawAnswer& answer, const AnswerCell& cell);

/// Appends a line with the JSON object of `write_json`.
void append_json(std::string& out, const glm::vec3& position, const CellLocation& location,
                 const RawAnswer& answer, const AnswerCell& cell);

/// Appends a line of numbers, the shortest that read back to the same floats.
void append_csv(std::string& out, const glm::vec3& position, const RawAnswer& answer);

/// The names of the numbers of such a line, with a line break.
[[nodiscard]] std::string csv_header();

}  // namespace tetralight::cli
