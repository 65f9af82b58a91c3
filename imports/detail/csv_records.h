// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include <tetralight/base/result.h>

namespace tetralight::detail {

/// The records of a text of comma-separated values, one after the other.
class CsvRecords {
  public:
    /// Precondition: the text outlives this object.
    explicit CsvRecords(std::string_view text);

    /// Reads the next record into `fields()`; blank lines are skipped. False at the end. Errors
    /// begin with the line.
    [[nodiscard]] Result<bool> next();

    /// The fields of the record: without quotes, or else without blanks around them.
    [[nodiscard]] const std::vector<std::string>& fields() const { return fields_; }

    /// The line on which the record begins, from 1.
    [[nodiscard]] size_t line() const { return record_line_; }

  private:
    [[nodiscard]] Status read_field(std::string& field);
    [[nodiscard]] Status read_quoted(std::string& field);
    void skip_blanks();
    [[nodiscard]] bool is_at_line_end() const;
    void skip_line_end();

    std::string_view rest_;
    char separator_ = ',';
    std::vector<std::string> fields_;
    size_t line_ = 1;
    size_t record_line_ = 1;
};

}  // namespace tetralight::detail
