// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace tetralight::detail {

/// Metadata that records in its member "relit" that a call changed the light after the bake, as
/// `tetralight relight` records its options there. `call` is added once to an earlier record.
/// Metadata that is not a JSON object is replaced. Precondition: `call` is a name.
[[nodiscard]] std::string record_relit(std::string_view metadata, std::string_view call);

}  // namespace tetralight::detail
