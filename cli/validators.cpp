// SPDX-License-Identifier: Apache-2.0
#include "cli/validators.h"

#include "base/text.h"
#include "cli/common.h"

namespace tetralight::cli {

CLI::Validator positions() {
    return numbers_in(-1e18, 1e18).description("");
}

CLI::Validator not_empty(const char* what) {
    const auto check = [what](const std::string& word) {
        return word.empty() ? text("the ", what, " is empty") : "";
    };
    return {check, ""};
}

}  // namespace tetralight::cli
