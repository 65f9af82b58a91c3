// SPDX-License-Identifier: Apache-2.0
#include <tetralight/batch/limits.h>

#include <tetralight/settings/read_values.h>

namespace tetralight {

using settings::Json;

Result<Json> read_limits(const Json& json) {
    if (!json.is_object()) return Error{ErrorCode::InvalidArgument, "limits: expected an object"};
    const auto values =
        settings::values_from_json(settings::kLimits, json, settings::Access::Service);
    if (!values) return values.error().in("limits");
    Json limits = Json::object();
    settings::kLimits.for_each([&](const settings::Setting& setting) {
        const std::string name(setting.name);
        if (values->is_given(name)) limits[name] = values->number(name);
    });
    return limits;
}

bool is_limited(const std::string& limit, const std::string& kind) {
    if (limit == "error") return kind == "probes" || kind == "lightmaps";
    return (limit == "dead_probes" || limit == "leak") && kind == "probes";
}

}  // namespace tetralight
