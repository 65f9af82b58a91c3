// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/section_text.h>

#include <algorithm>
#include <string>

#include <tetralight/base/str_cat.h>
#include <tetralight/base/utf8.h>
#include <tetralight/probes/probe_volume.h>
#include <tetralight/probes/section_error.h>

namespace tetralight::detail {

Status check_names(std::string_view section, std::string_view names) {
    if (!names.empty() && names.back() != '\n') {
        return section_error(section, "the last name has no line break at its end");
    }
    const auto lines = split_names(names);
    for (size_t i = 0; i < lines.size(); ++i) {
        if (!is_utf8(lines[i])) return section_error(section, str_cat("name ", i, " is not UTF-8"));
        if (has_control_character(lines[i])) {
            return section_error(section, str_cat("name ", i, " holds a control character"));
        }
    }
    return Ok{};
}

Status check_distinct_names(std::string_view section, std::string_view names) {
    if (auto status = check_names(section, names); !status) return status;
    auto lines = split_names(names);
    std::ranges::sort(lines);
    const auto twice = std::ranges::adjacent_find(lines);
    if (twice == lines.end()) return Ok{};
    return section_error(section, str_cat("name \"", *twice, "\" occurs twice"));
}

Status check_sorted_names(std::string_view section, std::string_view names) {
    if (auto status = check_names(section, names); !status) return status;
    const auto lines = split_names(names);
    for (size_t i = 1; i < lines.size(); ++i) {
        if (lines[i - 1] < lines[i]) continue;
        const bool is_same = lines[i - 1] == lines[i];
        return section_error(section, str_cat("name ", i, " \"", lines[i], "\" ",
                                              is_same ? "occurs twice" : "is not in sorted order"));
    }
    return Ok{};
}

Status check_metadata_text(std::string_view metadata) {
    if (!is_utf8(metadata)) return section_error("metadata", "is not UTF-8");
    const auto is_printable = [](char c) {
        return c == '\t' || c == '\n' || c == '\r' || !has_control_character({&c, 1});
    };
    const auto bad = std::ranges::find_if_not(metadata, is_printable);
    if (bad == metadata.end()) return Ok{};
    return section_error("metadata",
                         str_cat("byte ", bad - metadata.begin(), " is a control character"));
}

}  // namespace tetralight::detail
