// SPDX-License-Identifier: Apache-2.0
#include <tetralight/cli/json_file.h>

#include <span>
#include <string>
#include <string_view>

#include <tetralight/base/file.h>
#include <tetralight/base/json/json_text.h>
#include <tetralight/cli/common.h>

namespace tetralight::cli {

using settings::Json;

Json read_object(const std::filesystem::path& path) {
    const auto bytes = read_file(path.string());
    if (!bytes) return Json::object();
    const std::string_view text(reinterpret_cast<const char*>(bytes->data()), bytes->size());
    return check_json_object(text) ? Json::parse(text) : Json::object();
}

Status write_json(const std::filesystem::path& path, const Json& json) {
    const std::string text = dump(json, 1) + "\n";
    return write_file(path.string(), std::as_bytes(std::span(text)));
}

}  // namespace tetralight::cli
