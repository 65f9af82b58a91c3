// SPDX-License-Identifier: Apache-2.0
#include <tetralight/cli/values.h>

namespace tetralight::cli {

void refuse(const Values& values, std::string_view name, std::string_view message) {
    throw UsageError{values.error(name, message)};
}

void refuse_because(const Values& values, std::string_view name, const Error& reason) {
    Error error = values.error(name, "");
    error.message = reason.message.prefixed(values.shown(name) + ": ");
    throw UsageError{error};
}

void require(const Values& values, std::string_view name) {
    Error error = values.error(name, "");
    error.message = values.shown(name) + " is required";
    throw UsageError{error};
}

}  // namespace tetralight::cli
