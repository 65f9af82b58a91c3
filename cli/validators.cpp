// SPDX-License-Identifier: Apache-2.0
#include <tetralight/cli/validators.h>

#include <tetralight/base/str_cat.h>
#include <tetralight/cli/common.h>

namespace tetralight::cli {

CLI::Validator positions() {
    return numbers_in(-1e18, 1e18).description("");
}

CLI::Validator not_empty(const char* what) {
    const auto check = [what](const std::string& word) {
        return word.empty() ? str_cat("the ", what, " is empty") : "";
    };
    return {check, ""};
}

}  // namespace tetralight::cli
