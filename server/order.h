// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <tetralight/server/json.h>
#include <tetralight/server/store.h>
#include <tetralight/settings/setting.h>
#include <tetralight/settings/values.h>

// An order is the JSON object by which a client asks for a command: its settings, as the table of
// the command describes them, with ids or names of stored files instead of paths.

namespace tetralight::server {

/// A stored file, and its name in the folder of the job: the member that refers to it, "scene" or
/// "groups[0]". Messages of the command then name that member.
struct OrderFile {
    StoredFile file;
    std::string name;
};

/// Checks the members of an order against the settings that clients may set. `own_members`,
/// separated by blanks, are those that the endpoint reads itself. Throws a `Problem`: 400
/// "unknown_member", "missing_value" or "invalid_value".
settings::Values check_order(const settings::Table& table, const Json& order,
                             std::string_view own_members = {});

/// The files that a checked order refers to; `kind` is that of members such as "blend", whose names
/// do not tell it. Throws a `Problem` that names the member: 404 if there is no such file, 410 if
/// it is damaged.
[[nodiscard]] std::vector<OrderFile> order_files(Store& store, const settings::Table& table,
                                                 const Json& order, Kind kind = Kind::Volumes);

/// The settings of the job for a checked order. Depends on the order alone.
[[nodiscard]] Json job_settings(const settings::Table& table, const Json& order);

/// The kind of stored files that a setting refers to: the one that it is called after ("scene"), or
/// else `otherwise`.
[[nodiscard]] Kind kind_of(const settings::Setting& setting, Kind otherwise = Kind::Volumes);

/// True if a client may set it.
[[nodiscard]] bool is_for_clients(const settings::Setting& setting);

/// True if a value of the setting refers to stored files.
[[nodiscard]] bool refers_to_files(const settings::Setting& setting, const Json& value);

}  // namespace tetralight::server
