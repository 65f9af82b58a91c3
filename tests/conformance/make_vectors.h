// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace tetralight::conformance {

/// A file of tests/conformance/vectors.
struct VectorFile {
    std::string name;
    std::vector<std::byte> bytes;
};

/// All of them: a volume and its answers in turn. The same in each call.
[[nodiscard]] std::vector<VectorFile> make_vector_files();

}  // namespace tetralight::conformance
