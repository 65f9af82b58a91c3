// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec3.hpp>
#include <string>
#include <string_view>
#include <vector>

#include <tetralight/probes/probe_volume.h>
#include "tests/conformance/vector_answer.h"

// The JSON of conformance vectors, as docs/how_to_query.md describes it.

namespace tetralight::conformance {

/// Answers at the same options.
struct VectorCase {
    VectorOptions options;
    std::vector<VectorAnswer> answers;
};

struct VectorText {
    std::string volume;  ///< name of its file
    std::string about;
    float largest_light = 0.0f;
    std::vector<VectorCase> cases;
};

/// One answer a line. `volume` has the vertices of the cells.
[[nodiscard]] std::string write_vectors(const VectorText& vectors, const ProbeVolumeView& volume);

/// Reads what `write_vectors` writes. Precondition: the text is such JSON.
[[nodiscard]] VectorText read_vectors(std::string_view text);

}  // namespace tetralight::conformance
