// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <tetralight/server/database.h>
#include <tetralight/server/stored_file.h>

namespace tetralight::server {

/// The files that a database names, with their names. Throws a `DatabaseProblem`, and another
/// `std::exception` if the rows do not fit each other.
[[nodiscard]] std::vector<StoredFile> read_stored_files(Database& database);

/// "volumes/ID.probes": where a file lies in the data folder.
[[nodiscard]] std::string place_of(const StoredFile& file);

}  // namespace tetralight::server
