// SPDX-License-Identifier: Apache-2.0
#include <tetralight/cli/gizmo_settings.h>

#include <string>

#include <tetralight/base/str_cat.h>
#include <tetralight/settings/value_text.h>

namespace tetralight::cli {
namespace {

/// The position of "selection=1,2,3", whose words are separated by commas like those around it.
glm::dvec3 read_selection(const Values& values, std::string_view text) {
    constexpr settings::Setting kPosition{
        .name = "selection", .type = settings::Type::Vector, .range = settings::kPositions};
    const auto position = settings::value_from_text(kPosition, text);
    if (!position) {
        refuse_because(values, "show", position.error().in("selection needs three numbers"));
    }
    const auto v = position->get<std::array<double, 3>>();
    return {v[0], v[1], v[2]};
}

/// Removes and returns the text before the `count`th comma.
std::string_view take(std::string_view& text, int count) {
    size_t end = text.find(',');
    for (int i = 1; i < count && end != text.npos; ++i) end = text.find(',', end + 1);
    const std::string_view taken = text.substr(0, end);
    text.remove_prefix(end == text.npos ? text.size() : end + 1);
    return taken;
}

}  // namespace

GizmoSettings gizmo_settings(const Values& values) {
    constexpr std::string_view kSelection = "selection=";
    GizmoSettings settings;
    settings.ball_radius = values.number32("ball_radius");
    settings.probe_color = choice<ProbeColor>(values, "probe_color");
    const std::string text = values.text("show");
    for (std::string_view rest = text; !rest.empty() || text.ends_with(',');) {
        if (rest.starts_with(kSelection)) {
            settings.selection = read_selection(values, take(rest, 3).substr(kSelection.size()));
        } else if (const std::string_view word = take(rest, 1); word == "probes") {
            settings.has_probes = true;
        } else if (word == "cells") {
            settings.has_cells = true;
        } else if (word == "lppv") {
            settings.has_proxies = true;
        } else if (word == "openings") {
            settings.has_openings = true;
        } else {
            refuse(values, "show",
                   str_cat("\"", word,
                           "\" is none of probes, cells, lppv, openings, selection=x,y,z"));
        }
    }
    return settings;
}

}  // namespace tetralight::cli
