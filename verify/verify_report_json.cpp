// SPDX-License-Identifier: Apache-2.0
#include <nlohmann/json.hpp>

#include <tetralight/verify/verify_report.h>

namespace tetralight {
namespace {

using Json = nlohmann::ordered_json;

Json channels_json(const glm::dvec3& value) {
    return Json::array({value.x, value.y, value.z});
}

Json probe_json(const VerifyProbe& probe) {
    return {{"probe", probe.probe},
            {"position", channels_json(probe.position)},
            {"volume", channels_json(probe.volume)},
            {"volume_error", channels_json(probe.volume_error)},
            {"traced", channels_json(probe.traced.mean)},
            {"traced_error", channels_json(probe.traced.error)},
            {"samples", probe.traced.sample_count},
            {"z", channels_json(probe.z)},
            {"is_decided", probe.is_decided},
            {"directional_difference", probe.directional_difference}};
}

Json place_json(const VerifyPlace& place) {
    return {{"position", channels_json(place.position)},
            {"is_unseen", place.is_unseen},
            {"is_outside", place.is_outside},
            {"answer", channels_json(place.answer)},
            {"traced", channels_json(place.traced.mean)},
            {"traced_error", channels_json(place.traced.error)},
            {"samples", place.traced.sample_count},
            {"is_leak", place.is_leak},
            {"is_dark", place.is_dark}};
}

Json channel_json(const VerifyChannel& channel) {
    return {{"decided", channel.decided_count}, {"within_3_sigma", channel.within_3_sigma},
            {"mean_z", channel.mean_z},         {"rms_z", channel.rms_z},
            {"undecided", channel.undecided},   {"mean_difference", channel.mean_difference}};
}

Json failures_json(const VerifyReport& report) {
    Json failures = Json::array();
    for (const VerifyFailure& failure : report.failures) {
        failures.push_back({{"setting", failure.setting}, {"message", failure.message}});
    }
    return failures;
}

Json summary_json(const VerifyReport& report) {
    return {{"referee", report.referee},
            {"notes", report.notes},
            {"bounces", report.bounces},
            {"seed", report.seed},
            {"volume_probes", report.volume_probe_count},
            {"excluded",
             {{"dilated", report.excluded.dilated},
              {"inside", report.excluded.inside},
              {"overridden", report.excluded.overridden}}},
            {"rules",
             {{"widest_bar", report.rules.widest_bar},
              {"least_share", report.rules.least_share},
              {"leak_ratio", report.rules.leak_ratio},
              {"leak_floor", report.rules.leak_floor}}},
            {"samples", report.sample_count},
            {"untraced", report.untraced_count},
            {"channels",
             {{"red", channel_json(report.channels[0])},
              {"green", channel_json(report.channels[1])},
              {"blue", channel_json(report.channels[2])}}},
            {"directional_difference", report.directional_difference},
            {"interpolation",
             {{"mean", report.interpolation.mean},
              {"median", report.interpolation.median},
              {"p95", report.interpolation.p95},
              {"noise", report.interpolation.noise}}},
            {"mean_light", report.mean_light},
            {"leak_share", report.leak_share},
            {"dark_share", report.dark_share},
            {"unseen_share", report.unseen_share},
            {"outside_share", report.outside_share},
            {"failures", failures_json(report)}};
}

}  // namespace

std::string verify_report_json(const VerifyReport& report) {
    Json json = summary_json(report);
    json["probes"] = Json::array();
    for (const VerifyProbe& probe : report.probes) json["probes"].push_back(probe_json(probe));
    json["places"] = Json::array();
    for (const VerifyPlace& place : report.places) json["places"].push_back(place_json(place));
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace tetralight
