// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/transfer.h>

namespace tetralight {
namespace {

template <class T>
IrradianceSh product(const ProbeTransfer::Matrix<T>& matrix, const DistantLight& light) {
    IrradianceSh sum;
    for (int i = 0; i < kShCoefficientCount; ++i) {
        for (int j = 0; j < kDistantCoefficientCount; ++j) {
            sum.coefficients[i] += matrix[i][j] * light.coefficients[j];
        }
    }
    return sum;
}

}  // namespace

IrradianceSh transfer_direct(const ProbeTransfer& probe, const DistantLight& light) noexcept {
    return product(probe.direct, light);
}

IrradianceSh transfer_bounces(const ProbeTransfer& probe, const DistantLight& light) noexcept {
    return product(probe.bounced, light);
}

IrradianceSh transfer_light(const ProbeTransfer& probe, const DistantLight& light) noexcept {
    return transfer_direct(probe, light) + transfer_bounces(probe, light);
}

}  // namespace tetralight
