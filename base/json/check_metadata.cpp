// SPDX-License-Identifier: Apache-2.0
#include <tetralight/base/json/check_metadata.h>

#include <tetralight/base/json/json_text.h>

namespace tetralight {

Status check_metadata(std::string_view metadata) {
    if (metadata.empty()) return Ok{};
    const Status status = check_json_object(metadata);
    if (status) return Ok{};
    const Message& reason = status.error().message;
    return Error{ErrorCode::Corrupt, "metadata", "", reason.prefixed("section \"metadata\": ")};
}

}  // namespace tetralight
