// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/detail/vector_kernels.h>

namespace tetralight::detail {

const QueryKernels& query_kernels() noexcept {
    static constexpr QueryKernels kKernels{test_tetrahedra_in_vectors, hull_weights_in_vectors,
                                           blend_in_vectors};
    return kKernels;
}

}  // namespace tetralight::detail
