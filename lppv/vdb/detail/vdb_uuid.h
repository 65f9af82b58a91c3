// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

namespace tetralight::detail {

/// Replaces the random number in the header of an OpenVDB file by one that its contents give, so
/// that the same values give the same bytes. Leaves other files alone.
void set_vdb_uuid(std::span<char> file);

}  // namespace tetralight::detail
