// SPDX-License-Identifier: Apache-2.0
#include "base/text.h"
#include "cli/common.h"
#include "cli/paths.h"
#include "probes/probe_file.h"

#include <glm/common.hpp>

namespace tetralight::cli {
namespace {

const char* name_of(LightType type) {
    switch (type) {
        case LightType::Directional:
            return "directional";
        case LightType::Point:
            return "point";
        case LightType::Spot:
            return "spot";
    }
    return "unknown";
}

Json groups_json(const ProbeVolumeView& volume) {
    const auto names = split_names(volume.group_names);
    std::vector<size_t> probe_counts(names.size(), 0);
    for (const ProbeSource& source : volume.sources) ++probe_counts[source.group];
    Json groups = Json::array();
    for (size_t i = 0; i < names.size(); ++i) {
        groups.push_back({{"name", names[i]}, {"probes", probe_counts[i]}});
    }
    return groups;
}

Json lights_json(const ProbeVolumeView& volume) {
    const auto names = split_names(volume.light_names);
    Json lights = Json::array();
    for (size_t i = 0; i < volume.lights.size(); ++i) {
        const Light& light = volume.lights[i];
        lights.push_back({{"name", i < names.size() ? names[i] : ""},
                          {"type", name_of(light.type)},
                          {"mode", light.mode == LightMode::Baked ? "baked" : "mixed"}});
    }
    return lights;
}

Json bounds_json(const ProbeVolumeView& volume) {
    if (volume.positions.empty()) return nullptr;
    glm::vec3 low = volume.positions[0];
    glm::vec3 high = volume.positions[0];
    for (const glm::vec3& p : volume.positions) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    return {{"min", to_json(glm::dvec3(low) + volume.info.world_origin)},
            {"max", to_json(glm::dvec3(high) + volume.info.world_origin)}};
}

struct Info {
    std::string path;
    CommonOptions common;

    void add_to(CLI::App& command) {
        add_path(command, "VOLUME", path, "Probe volume (.probes)")->required();
        common.add_to(command);
    }

    Status run() {
        const auto file = open_probe_file(path);
        if (!file) return file.error();
        const ProbeVolumeView& volume = file->view();
        Json json{{"file", path}};
        json.update(counts(volume));
        json["is_baked"] = !volume.irradiance.empty();
        json["bounds"] = bounds_json(volume);
        json["radial_share"] = volume.info.radial_share;
        json["group_list"] = groups_json(volume);
        json["lights"] = lights_json(volume);
        json["made_with"] = Json::parse(volume.metadata, nullptr, false);
        if (json["made_with"].is_discarded()) json["made_with"] = nullptr;
        uint64_t bytes = 0;
        for (const auto& section : file->sections()) {
            json["section_bytes"][section.name] = section.size;
            bytes += section.size;
        }
        json["bytes"] = bytes;
        common.print(json, dump(json, 2));
        return Ok{};
    }
};

}  // namespace

void add_info(CLI::App& app, Run& run) {
    add_command<Info>(app, run, "info", "Say what a probe volume holds",
                      "tetralight info courtyard.probes");
}

}  // namespace tetralight::cli
