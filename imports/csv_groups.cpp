// SPDX-License-Identifier: Apache-2.0
#include <tetralight/imports/csv_groups.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <optional>
#include <string_view>
#include <unordered_map>
#include <utility>

#include <tetralight/base/str_cat.h>
#include <tetralight/imports/detail/csv_records.h>
#include <tetralight/imports/detail/text_file.h>

namespace tetralight {
namespace {

using Fields = std::vector<std::string>;

constexpr std::array<std::string_view, 4> kColumnNames = {"x", "y", "z", "group"};
constexpr size_t kGroupColumn = 3;

/// Where a table has what is read of it.
struct CsvColumns {
    /// The columns of x, y, z and of the group, which may be missing.
    std::array<std::optional<size_t>, 4> places;
    size_t count = 0;
    bool is_header = false;
    /// Names of columns that are not read.
    Fields others{};
};

Result<CsvColumns> columns_without_header(size_t count) {
    if (count != 3 && count != 4) {
        return Error{ErrorCode::Corrupt,
                     str_cat("has ", count, count == 1 ? " column" : " columns",
                             ", not three (x, y, z) or four (x, y, z, group); others need a first "
                             "line with their names")};
    }
    CsvColumns columns{{0, 1, 2, std::nullopt}, count};
    if (count == 4) columns.places[kGroupColumn] = 3;
    return columns;
}

Result<CsvColumns> columns_of_header(const Fields& names) {
    CsvColumns columns{{}, names.size(), true};
    for (size_t i = 0; i < names.size(); ++i) {
        const auto name = std::ranges::find(kColumnNames, detail::in_lower_case(names[i]));
        if (name == kColumnNames.end()) {
            columns.others.push_back(detail::quoted_text(names[i]));
            continue;
        }
        auto& place = columns.places[static_cast<size_t>(name - kColumnNames.begin())];
        if (place) {
            return Error{ErrorCode::Corrupt, std::string(*name), "",
                         str_cat("two columns are named ", *name)};
        }
        place = i;
    }
    for (size_t axis = 0; axis < 3; ++axis) {
        if (columns.places[axis]) continue;
        return Error{ErrorCode::Corrupt, std::string(kColumnNames[axis]), "",
                     str_cat("no column is named ", kColumnNames[axis])};
    }
    return columns;
}

Result<CsvColumns> columns_of(const Fields& first) {
    const bool has_number = std::ranges::any_of(first, [](const std::string& field) {
        const auto number = detail::parse_number(field, "");
        return number || field == "nan" || field == "inf" || field == "-inf";
    });
    return has_number ? columns_without_header(first.size()) : columns_of_header(first);
}

class CsvGroups {
  public:
    explicit CsvGroups(const std::string& path)
        : name_of_file_(std::filesystem::path(path).stem().string()) {}

    Status add(const CsvColumns& columns, const Fields& fields) {
        if (fields.size() != columns.count) {
            return Error{ErrorCode::Corrupt,
                         str_cat("has ", fields.size(), fields.size() == 1 ? " field" : " fields",
                                 ", the first line has ", columns.count)};
        }
        glm::dvec3 position{};
        for (int axis = 0; axis < 3; ++axis) {
            const auto i = static_cast<size_t>(axis);
            const auto number = detail::parse_number(fields[*columns.places[i]], kColumnNames[i]);
            if (!number) return number.error();
            position[axis] = *number;
        }
        const auto place = columns.places[kGroupColumn];
        return add(place ? fields[*place] : name_of_file_, position);
    }

    std::vector<ProbeGroup> groups;

  private:
    Status add(const std::string& name, const glm::dvec3& position) {
        auto found = group_of_name_.find(name);
        if (found == group_of_name_.end()) {
            if (auto status = detail::check_group_name(name); !status) return status;
            found = group_of_name_.emplace(name, groups.size()).first;
            groups.emplace_back().name = name;
        }
        groups[found->second].positions.push_back(position);
        return Ok{};
    }

    std::string name_of_file_;
    std::unordered_map<std::string, size_t> group_of_name_;
};

std::string columns_warning(const std::string& path, const Fields& names) {
    constexpr size_t kMostNames = 5;
    std::string list;
    for (size_t i = 0; i < std::min(names.size(), kMostNames); ++i)
        list += (i == 0 ? "" : ", ") + names[i];
    if (names.size() > kMostNames) list += ", ...";
    return str_cat(path, ": columns other than x, y, z and group are not read (", list, ")");
}

}  // namespace

Result<ImportedGroups> read_csv_groups(const std::string& path) {
    const auto file = detail::TextFile::open(path);
    if (!file) return file.error();
    detail::CsvRecords records(file->text());
    std::optional<CsvColumns> columns;
    CsvGroups result(path);
    while (true) {
        const auto has_record = records.next();
        if (!has_record)
            return Error(has_record.error().code, has_record.error().message.prefixed(path + ":"));
        if (!*has_record) break;
        const auto located = [&](const Error& error) {
            return error.in(str_cat(path, ":", records.line()));
        };
        const bool is_first = !columns;
        if (is_first) {
            auto found = columns_of(records.fields());
            if (!found) return located(found.error());
            columns = std::move(*found);
            if (columns->is_header) continue;
        }
        if (auto status = result.add(*columns, records.fields()); !status)
            return located(status.error());
    }
    if (result.groups.empty())
        return Error{ErrorCode::NotFound, "groups", path, path + ": has no positions"};
    ImportedGroups imported{std::move(result.groups), {}};
    if (!columns->others.empty()) imported.warnings = {columns_warning(path, columns->others)};
    return imported;
}

}  // namespace tetralight
