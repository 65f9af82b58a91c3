// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/detail/vector_kernels.h>

namespace tetralight::detail {

const QueryKernels& query_kernels() noexcept {
    static constexpr QueryKernels kKernels{
        place_queries_in_vectors,      begin_walks_in_vectors,        test_tetrahedra_in_vectors,
        measure_tetrahedra_in_vectors, measure_hull_cells_in_vectors, blend_in_vectors};
    return kKernels;
}

}  // namespace tetralight::detail
