// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

namespace tetralight::detail {

/// Replaces the UUID in the header of an OpenVDB file by a hash of the file's contents, so that the
/// same values give the same bytes. OpenVDB writes a random UUID and offers no way to set it:
/// openvdb::io::Archive keeps it in a private member that writeHeader() redefines. Does nothing to
/// files that are not OpenVDB files.
void set_vdb_uuid(std::span<char> file);

}  // namespace tetralight::detail
