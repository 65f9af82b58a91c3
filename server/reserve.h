// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace tetralight::server {

// Space of the disk that a file of zeros holds, for the day on which the disk is full: deleting
// needs some, too.

/// Makes the file as large as it should be, or as the disk lets it.
void keep_reserve(const std::string& path);

/// Gives the space back.
void drop_reserve(const std::string& path);

}  // namespace tetralight::server
