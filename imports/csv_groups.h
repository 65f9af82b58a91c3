// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <tetralight/base/result.h>
#include <tetralight/imports/imported_groups.h>

namespace tetralight {

/// Reads probe groups from a table of positions (RFC 4180): metres, right-handed, Y up.
///
///     x,y,z,group
///     0,1.5,0,hall
///     2,1.5,0,"hall, upper floor"
///
/// - Columns are separated by commas, semicolons or tabs: by semicolons if the first line has one,
///   else by tabs if it has one.
/// - If no field of the first line is a number, it names the columns: x, y, z and, optionally,
///   group, in any order and case. Other columns are skipped with a warning. Without it the columns
///   are x, y and z, or x, y, z and group.
/// - Without a group column all positions are one group, with the name of the file.
/// - Fields may be in double quotes, which are doubled inside. Lines end with LF or CR LF; blank
///   lines are skipped. Numbers have a decimal point.
///
/// Groups are in the order in which they first occur. Returns corrupt, with file, line and column,
/// for all else, and not_found if there are no positions.
[[nodiscard]] Result<ImportedGroups> read_csv_groups(const std::string& path);

}  // namespace tetralight
