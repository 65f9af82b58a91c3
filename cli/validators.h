// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>

namespace tetralight::cli {

/// Metres of a position: what `merge` takes, too.
[[nodiscard]] CLI::Validator positions();

/// Not an empty word, which messages call by what it is.
[[nodiscard]] CLI::Validator not_empty(const char* what);

}  // namespace tetralight::cli
