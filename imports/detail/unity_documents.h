// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include <tetralight/base/result.h>

namespace tetralight::detail {

/// One object of a text file of Unity: `--- !u!CLASS &ID stripped`, and the YAML below it.
struct UnityDocument {
    int64_t class_id = 0;
    int64_t id = 0;
    bool is_stripped = false;
    std::string_view body{};
    /// The line of the header, from 1. The body begins on the next one.
    size_t line = 0;
};

/// The objects of a text file of Unity, one after the other. Headers are read here, because
/// "stripped" in them is not YAML; so only the objects that matter need to be parsed.
class UnityDocuments {
  public:
    /// Precondition: the text outlives this object and its documents.
    explicit UnityDocuments(std::string_view text) : rest_(text) {}

    /// The next object; none at the end. Returns corrupt, with the line, for a file that does not
    /// begin with %YAML, and a header that cannot be read.
    [[nodiscard]] Result<std::optional<UnityDocument>> next();

  private:
    [[nodiscard]] Status skip_directives();
    std::string_view take_line();

    std::string_view rest_;
    /// That of the first line of `rest_`.
    size_t line_ = 1;
    bool is_at_start_ = true;
};

}  // namespace tetralight::detail
