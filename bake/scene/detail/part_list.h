// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <unordered_map>
#include <vector>

#include <tetralight/bake/scene/scene_parts.h>

namespace tetralight::detail {

/// Collects the table of what was read of a scene: elements that were treated alike share a row.
class PartList {
  public:
    /// Adds one element to the row of this name, use and note, which is made if there is none.
    /// `part` has no count and no elements of its own.
    void add(const ScenePart& part, const std::string& element);

    /// Adds an element that is left out: `note` says why. `changes_light` as ScenePart.
    void add_left_out(const std::string& name, const std::string& note, bool changes_light,
                      const std::string& element);

    /// Adds many of a kind that have no names.
    void add_count(ScenePart part, uint64_t count);

    /// Adds the elements of rows.
    void append(const std::vector<ScenePart>& parts);

    /// Rows of different names, uses or notes that are kept; more of them share one row after
    /// these.
    static constexpr size_t kMaxRows = 1000;

    /// Rows in the order in which they were begun.
    [[nodiscard]] const std::vector<ScenePart>& parts() const { return parts_; }

  private:
    ScenePart& row(const ScenePart& part);

    std::vector<ScenePart> parts_;
    /// Index in `parts_` by use, name and note.
    std::unordered_map<std::string, size_t> rows_;
};

/// What a warning says of a part: `NAME (2 materials...): NOTE; REMEDY`.
[[nodiscard]] std::string part_warning(const ScenePart& part);

}  // namespace tetralight::detail
