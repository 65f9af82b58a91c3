// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace tetralight {

/// The qualified names that a header defines at namespace scope: types, aliases, concepts,
/// functions with a body (with the types of their parameters: "a::area(const Box&)") and variables
/// with a value. Declarations without a definition, members and operators are left out.
[[nodiscard]] std::vector<std::string> names_defined_in(const std::string& header_text);

}  // namespace tetralight
