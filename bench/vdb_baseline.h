// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <tetralight/lppv/lppv.h>

namespace tetralight::bench {

/// Writes the same grids as `write_vdb`, with OpenVDB's copyFromDense and io::File.
void write_vdb_by_openvdb(const std::string& path, const Lppv& lppv);

}  // namespace tetralight::bench
