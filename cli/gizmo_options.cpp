// SPDX-License-Identifier: Apache-2.0
#include <tetralight/cli/gizmo_options.h>

#include <string>
#include <vector>

#include <tetralight/cli/choice.h>
#include <tetralight/cli/common.h>
#include <tetralight/cli/validators.h>

namespace tetralight::cli {
namespace {

std::vector<std::string> split_at_commas(const std::string& text) {
    std::vector<std::string> words{""};
    for (const char c : text) {
        c == ',' ? words.emplace_back() : words.back() += c;
    }
    return words;
}

/// "probes,cells,selection=1,2,3,lppv". Returns what is wrong with it, or nothing.
std::string parse_show(const std::string& text, GizmoSettings& settings) {
    const std::string kSelection = "selection=";
    const std::vector<std::string> words = split_at_commas(text);
    for (size_t i = 0; i < words.size(); ++i) {
        const std::string& word = words[i];
        if (word == "probes") {
            settings.has_probes = true;
        } else if (word == "cells") {
            settings.has_cells = true;
        } else if (word == "lppv") {
            settings.has_proxies = true;
        } else if (word.starts_with(kSelection)) {
            const std::string y = i + 1 < words.size() ? words[i + 1] : "";
            const std::string z = i + 2 < words.size() ? words[i + 2] : "";
            std::string place = word.substr(kSelection.size()) + "," + y + "," + z;
            settings.selection = parse_vec3(place);
            if (!settings.selection) return "selection needs three numbers: selection=x,y,z";
            if (const std::string wrong = positions()(place); !wrong.empty()) {
                return "selection: " + wrong;
            }
            i += 2;
        } else {
            return "\"" + word + "\" is none of probes, cells, lppv, selection=x,y,z";
        }
    }
    return {};
}

}  // namespace

void GizmoOptions::add_to(CLI::App& command) {
    auto* show = command.add_option_function<std::string>(
        "--show",
        [this](const std::string& text) {
            const std::string wrong = parse_show(text, settings);
            if (!wrong.empty()) throw CLI::ValidationError("--show", wrong);
        },
        "Draw over the scene, with commas between: probes (white balls, lit by what they hold), "
        "cells (their edges; those of the hull in orange), lppv (the points of proxy volumes), "
        "selection=x,y,z (the cell of a place, its probes with their weights, and the light they "
        "give)");
    command
        .add_option("--ball-radius", settings.ball_radius,
                    "Radius of the balls (default: from the space between them)")
        ->check(numbers_in(1e-6, 1e9))
        ->needs(show);
    add_choice(command, "--probe-color", settings.probe_color,
               {{"light", ProbeColor::Light},
                {"validity", ProbeColor::Validity},
                {"error", ProbeColor::Error}},
               "What the balls of probes show instead: validity = share of directions without back "
               "faces, error = relative standard error; teal is good, yellow fair, red bad")
        ->needs(show);
}

}  // namespace tetralight::cli
