// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>

#include <tetralight/runtime/tetralight.h>

// Holds the C API against the conformance vectors (docs/how_to_query.md), as write_cases.py writes
// them: a number of cases, and each case as these words of 32 bits:
//
//     largest light, outside, fade distance, walls, rendering layers, radius, normal offset (or
//     -1), number of layer weights, layer weights, number of answers, answers: position 3, normal
//     3, coefficients 27, occlusion 4

namespace tetralight::portability {

struct CheckResult {
    uint32_t case_count = 0;
    uint32_t answer_count = 0;
    /// The largest difference over what it may be: at most 1 if all answers are right.
    double worst = 0.0;
    /// What failed; empty if all calls succeeded.
    std::string failure;

    [[nodiscard]] bool passed() const { return failure.empty() && worst <= 1.0; }
};

/// Opens the volume of the cases; returns null after a failure.
using OpenVolume = std::function<tetralight_volume*(tetralight_error*)>;

[[nodiscard]] CheckResult check_answers(const OpenVolume& open, std::span<const uint32_t> words);

}  // namespace tetralight::portability
