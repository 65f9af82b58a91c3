// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

namespace tetralight {

/// Bytes of memory that this process may still allocate: the free memory of the system, or of its
/// control group if that is less. The largest number if the system does not tell.
[[nodiscard]] uint64_t free_memory();

/// sum + count · size; the largest number if that is greater.
[[nodiscard]] uint64_t add_bytes(uint64_t sum, uint64_t count, uint64_t size = 1);

/// "20.3 GB", to a tenth.
[[nodiscard]] std::string gigabytes(double bytes);
[[nodiscard]] std::string gigabytes(uint64_t bytes);

}  // namespace tetralight
