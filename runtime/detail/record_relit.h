// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace tetralight::detail {

/// Returns metadata whose member "relit" also holds the name of a function that changed the light.
/// `tetralight relight` stores its options in the same member. A name that it already holds is not
/// added again: a game may relight in each frame. Metadata that is not a JSON object is replaced.
/// Precondition: `call` needs no escapes in JSON.
[[nodiscard]] std::string record_relit(std::string_view metadata, std::string_view call);

}  // namespace tetralight::detail
