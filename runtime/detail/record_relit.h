// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace tetralight::detail {

/// Adds the name of a call that changed the light to the member "relit" of metadata, where
/// `tetralight relight` records its options. A name that is there is not added again, so that a
/// game can relight in each frame. Metadata that is not a JSON object is replaced by one.
/// Precondition: `call` needs no escapes in JSON.
[[nodiscard]] std::string record_relit(std::string_view metadata, std::string_view call);

}  // namespace tetralight::detail
