// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace tetralight::server {

/// server/openapi.json, as it was when the program was built.
[[nodiscard]] std::string_view openapi_text() noexcept;

}  // namespace tetralight::server
