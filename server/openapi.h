// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace tetralight::server {

/// server/openapi.json when the program was built.
[[nodiscard]] std::string_view openapi_text() noexcept;

/// What /openapi.json serves: that text, in which each schema with "x-settings" is completed from
/// the settings of that command. Each of their properties has the heading of its group as
/// "x-group".
[[nodiscard]] std::string openapi_document();

}  // namespace tetralight::server
