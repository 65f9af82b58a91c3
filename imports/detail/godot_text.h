// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <glm/mat4x4.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <tetralight/base/result.h>

namespace tetralight::detail {

/// `key=value` of a heading. The value is as the file has it, with quotes.
struct GodotAttribute {
    std::string_view key;
    std::string_view value;
};

/// A part of a text file of Godot: a heading `[node name="Hall" type="Node3D"]`, or a property
/// `transform = Transform3D(...)` of the heading before it.
struct GodotEntry {
    bool is_heading = false;
    /// "node", "transform".
    std::string_view name{};
    /// Those of a heading.
    std::vector<GodotAttribute> attributes{};
    /// That of a property, without blanks around it.
    std::string_view value{};
    /// The line on which the entry begins, from 1.
    size_t line = 1;

    /// The value of an attribute as the file has it.
    [[nodiscard]] std::optional<std::string_view> attribute(std::string_view key) const;

    /// The text of an attribute, without quotes and escapes. Returns corrupt if the value is not a
    /// string.
    [[nodiscard]] Result<std::optional<std::string>> text_attribute(std::string_view key) const;
};

/// The entries of a text file of Godot, one after the other. Values are skipped as balanced
/// brackets and strings, so that properties of any type may stand in the file.
class GodotText {
  public:
    /// Precondition: the text outlives this object and its entries.
    explicit GodotText(std::string_view text) : rest_(text) {}

    /// The next entry; none at the end. Errors begin with the line.
    [[nodiscard]] Result<std::optional<GodotEntry>> next();

  private:
    [[nodiscard]] Result<std::optional<GodotEntry>> heading();
    [[nodiscard]] Result<std::optional<GodotEntry>> property();
    /// Takes a value up to a character of `ends` outside of brackets and strings.
    [[nodiscard]] Result<std::string_view> value(std::string_view ends);
    [[nodiscard]] Status skip_string();
    std::string_view take(size_t length);
    void skip_space();

    std::string_view rest_;
    size_t line_ = 1;
};

/// The text of a quoted string; none if the value is anything else.
[[nodiscard]] std::optional<std::string> parse_godot_string(std::string_view value);

/// Parses `Transform3D(xx, xy, xz, yx, yy, yz, zx, zy, zz, ox, oy, oz)`: the rows of the basis,
/// then the origin. Returns corrupt, with the field `transform`.
[[nodiscard]] Result<glm::dmat4> parse_godot_transform(std::string_view value);

}  // namespace tetralight::detail
