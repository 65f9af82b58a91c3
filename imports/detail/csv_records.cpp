// SPDX-License-Identifier: Apache-2.0
#include <tetralight/imports/detail/csv_records.h>

#include <algorithm>

#include <tetralight/base/str_cat.h>
#include <tetralight/imports/detail/text_file.h>

namespace tetralight::detail {
namespace {

/// More than any table of probes has. A line of separators alone needs no memory beyond it.
constexpr size_t kMostColumns = 1024;

char separator_of(std::string_view first_line) {
    for (const char separator : {';', '\t'}) {
        if (first_line.find(separator) != std::string_view::npos) return separator;
    }
    return ',';
}

Error error_at(size_t line, std::string message) {
    return {ErrorCode::Corrupt, str_cat(line, ": ", message)};
}

}  // namespace

CsvRecords::CsvRecords(std::string_view text)
    : rest_(text), separator_(separator_of(text.substr(0, text.find('\n')))) {}

void CsvRecords::skip_blanks() {
    while (rest_.starts_with(' ') || (separator_ != '\t' && rest_.starts_with('\t')))
        rest_.remove_prefix(1);
}

bool CsvRecords::is_at_line_end() const {
    return rest_.empty() || rest_.starts_with('\n') || rest_.starts_with("\r\n") || rest_ == "\r";
}

void CsvRecords::skip_line_end() {
    const size_t length = rest_.starts_with("\r\n") ? 2 : 1;
    rest_.remove_prefix(std::min(length, rest_.size()));
    ++line_;
}

Status CsvRecords::read_quoted(std::string& field) {
    const size_t first_line = line_;
    rest_.remove_prefix(1);
    while (true) {
        const size_t length = rest_.find('"');
        if (length == std::string_view::npos)
            return error_at(first_line, "the quotes that begin here do not end");
        const std::string_view part = rest_.substr(0, length);
        line_ += static_cast<size_t>(std::ranges::count(part, '\n'));
        field += part;
        rest_.remove_prefix(length + 1);
        if (!rest_.starts_with('"')) break;
        field += '"';
        rest_.remove_prefix(1);
    }
    skip_blanks();
    if (is_at_line_end() || rest_.front() == separator_) return Ok{};
    return error_at(line_, str_cat("column ", fields_.size(), ": text follows closing quotes (",
                                   quoted_text(rest_.substr(0, rest_.find('\n'))), ")"));
}

Status CsvRecords::read_field(std::string& field) {
    skip_blanks();
    if (rest_.starts_with('"')) return read_quoted(field);
    const char ends[] = {separator_, '\n', '\0'};
    std::string_view text = rest_.substr(0, rest_.find_first_of(ends));
    rest_.remove_prefix(text.size());
    if (text.ends_with('\r')) text.remove_suffix(1);
    while (text.ends_with(' ') || text.ends_with('\t')) text.remove_suffix(1);
    field = text;
    return Ok{};
}

Result<bool> CsvRecords::next() {
    fields_.clear();
    while (skip_blanks(), !rest_.empty() && is_at_line_end()) skip_line_end();
    if (rest_.empty()) return false;
    record_line_ = line_;
    while (true) {
        if (fields_.size() == kMostColumns)
            return error_at(line_, str_cat("there are more than ", kMostColumns, " columns"));
        if (auto status = read_field(fields_.emplace_back()); !status) return status.error();
        if (is_at_line_end()) break;
        rest_.remove_prefix(1);  // the separator
    }
    skip_line_end();
    return true;
}

}  // namespace tetralight::detail
