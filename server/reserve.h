// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace tetralight::server {

// Disk space that a file of zeros reserves, because deleting needs some space even when the disk
// is full.

/// Makes the file as large as intended, or as the disk allows.
void keep_reserve(const std::string& path);

/// Releases the space.
void drop_reserve(const std::string& path);

}  // namespace tetralight::server
