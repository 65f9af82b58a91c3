// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/placement/candidate_count.h>

#include <string>

#include <tetralight/bake/rays/memory_estimate.h>
#include <tetralight/base/str_cat.h>

namespace tetralight {
namespace {

/// A candidate with its position and fate, and the memory that writing the output takes.
constexpr double kBytesPerCandidate = 400.0;
/// A probe with its light and sensors, in two volumes with their cells, and the memory that
/// building them takes.
constexpr double kBytesPerRefinedProbe = 8000.0;

std::string a_grid_of(double count) {
    constexpr double kLargestInteger = 1e18;
    if (!(count < kLargestInteger)) return str_cat("a grid of ", count, " probes");
    return str_cat("a grid of ", static_cast<uint64_t>(count), " probes");
}

Status check_memory(double count, double bytes_each, uint64_t free_bytes) {
    const double bytes = count * bytes_each;
    if (bytes <= static_cast<double>(free_bytes)) return Ok{};
    return Error{ErrorCode::OutOfResources,
                 str_cat(a_grid_of(count), " needs about ", gigabytes(bytes), " of memory, ",
                         gigabytes(free_bytes), " are free")};
}

}  // namespace

Status check_candidate_count(double count, uint64_t max_count, uint64_t free_bytes) {
    if (!(count <= static_cast<double>(max_count))) {
        return Error{ErrorCode::InvalidArgument, "max_probes", str_cat(max_count),
                     str_cat(a_grid_of(count), " is more than the limit of ", max_count)};
    }
    return check_memory(count, kBytesPerCandidate, free_bytes);
}

Status check_refined_count(uint64_t count, uint64_t free_bytes) {
    return check_memory(static_cast<double>(count), kBytesPerRefinedProbe, free_bytes);
}

}  // namespace tetralight
