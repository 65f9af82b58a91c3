// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace tetralight {

/// What a reader did with a part of a scene file.
enum class PartUse : uint8_t {
    Read,          ///< as the file's format defines it
    Approximated,  ///< close to that
    Ignored,
};

/// One row of the table of what was read of a scene file: elements that were treated alike.
struct ScenePart {
    PartUse use = PartUse::Read;
    /// What it is: "triangles", "KHR_materials_clearcoat", "misspelt extras \"contributeGI\"".
    std::string name;
    uint64_t count = 0;
    /// Names of the elements as messages write them: `node 3 "door"`. At most kMaxElements.
    std::vector<std::string> elements;
    /// How it was approximated, or why it was ignored; empty if it was read.
    std::string note;
    /// What the user can do, one sentence; may be empty.
    std::string remedy;
    /// True if the light would change if the part were read as the format defines it.
    bool changes_light = false;

    static constexpr size_t kMaxElements = 8;

    bool operator==(const ScenePart&) const = default;
};

}  // namespace tetralight
