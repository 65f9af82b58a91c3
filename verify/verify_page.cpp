// SPDX-License-Identifier: Apache-2.0
#include <tetralight/verify/verify_page.h>

#include <algorithm>
#include <cmath>

#include <tetralight/base/str_cat.h>
#include <tetralight/verify/html.h>
#include <tetralight/verify/verify_charts.h>
#include <tetralight/verify/verify_checks.h>
#include <tetralight/verify/verify_page_style.h>

namespace tetralight {
namespace {

constexpr size_t kWorstCount = 10;

using Cells = std::vector<std::string>;

std::string heading(const char* text) {
    return element("h2", escape_html(text));
}

std::string paragraph(const std::string& text) {
    return element("p", escape_html(text));
}

std::string figure(const std::string& picture, const std::string& caption) {
    return element("figure", picture + element("figcaption", escape_html(caption)));
}

std::string metres(const glm::dvec3& position) {
    return str_cat(fixed_point(position.x, 3), ", ", fixed_point(position.y, 3), ", ",
                   fixed_point(position.z, 3));
}

/// "0.512, 0.498, 0.301".
std::string light_text(const glm::dvec3& light) {
    return str_cat(significant(light.x), ", ", significant(light.y), ", ", significant(light.z));
}

/// The first `kWorstCount` after sorting by a value, the largest first.
template <class Element, class Value>
std::vector<const Element*> worst(const std::vector<Element>& elements, const Value& value) {
    std::vector<const Element*> sorted;
    for (const Element& one : elements) sorted.push_back(&one);
    std::ranges::stable_sort(sorted, std::ranges::greater{},
                             [&](const Element* one) { return value(*one); });
    sorted.resize(std::min(sorted.size(), kWorstCount));
    return sorted;
}

// Parts of the page, in their order

std::string verdict(const VerifyReport& report, const VerifyPageFacts& facts) {
    const auto checks = list_checks(report, facts.limits);
    const auto kept = std::ranges::count(checks, true, &VerifyCheck::is_kept);
    const auto count = static_cast<std::ptrdiff_t>(checks.size());
    std::string text =
        kept == count ? str_cat("Passed: all ", count, " limits are kept.")
                      : str_cat("Failed: ", count - kept, " of ", count, " limits are not kept.");
    if (count == 0) text = "Nothing was compared.";
    HtmlTable table("Limits and values", Cells{"Value", "Limit", "Found", "Result"});
    for (const VerifyCheck& check : checks) {
        table.add_row(Cells{check.what, check.limit, check.value,
                            check.is_kept ? "\u2713 passed" : "\u2717 failed"});
    }
    return element(kept == count ? "p class=\"verdict good\"" : "p class=\"verdict bad\"",
                   element("strong", escape_html(text))) +
           table.html();
}

std::string compared(const VerifyReport& report) {
    std::string text = str_cat("Referee: ", report.referee, ". Compared: ", report.probes.size(),
                               " of ", report.volume_probe_count, " probes and ",
                               report.places.size(), " places in free space between them, with ",
                               significant(static_cast<double>(report.sample_count)), " paths.");
    if (report.excluded.total() > 0) {
        text += str_cat(" Probes that cannot be compared: ", report.excluded.dilated,
                        " with the light of their neighbors, ", report.excluded.inside,
                        " inside geometry, ", report.excluded.overridden,
                        " changed by adjustment volumes.");
    }
    if (report.untraced_count > 0) {
        text += str_cat(" Not traced, because the time was over: ", report.untraced_count, ".");
    }
    std::string notes;
    for (const std::string& note : report.notes) notes += element("li", escape_html(note));
    return heading("What was compared") + paragraph(text) +
           paragraph(
               "Light is mean irradiance over all normals, in the unit of the scene's lights "
               "(glTF: lux). z is the difference in standard errors of both together: if "
               "both are right, 99.7 % of z lie between −3 and 3, and their mean is 0.") +
           element("ul", notes);
}

std::string scene_pictures(const VerifyPageFacts& facts) {
    std::string pictures;
    for (const VerifyPicture& picture : facts.pictures) {
        pictures += figure(str_cat("<img alt=\"", escape_html(picture.caption), "\" src=\"",
                                   data_uri("image/png", picture.png), "\">\n"),
                           picture.caption);
    }
    if (pictures.empty()) return "";
    return heading("The scene") + element("div class=\"two\"", pictures);
}

std::string channel_table(const VerifyReport& report) {
    HtmlTable table("Probes by channel", Cells{"Channel", "Decided", "Within 3 standard errors",
                                               "Mean z", "RMS z", "Undecided", "Mean difference"});
    for (size_t i = 0; i < report.channels.size(); ++i) {
        const VerifyChannel& channel = report.channels[i];
        table.add_row(Cells{kChannelNames[i], str_cat(channel.decided_count),
                            percent_text(channel.within_3_sigma), fixed_point(channel.mean_z, 3),
                            fixed_point(channel.rms_z, 3), percent_text(channel.undecided),
                            percent_text(channel.mean_difference)});
    }
    return table.html();
}

std::string probe_charts(const VerifyReport& report) {
    if (report.probes.empty()) return "";
    std::string histograms, scatters;
    for (size_t i = 0; i < report.channels.size(); ++i) {
        histograms += element("figure", z_histogram(report, i));
        scatters += element("figure", light_scatter(report, i));
    }
    return heading("Probes") + channel_table(report) +
           paragraph(str_cat("Over all normals and channels, the median difference is ",
                             percent_text(report.directional_difference), " of the irradiance.")) +
           paragraph(
               "Histograms of z. The curve is what chance gives; dashed lines are 3 standard "
               "errors. The outer bars hold what is beyond.") +
           element("div class=\"three\"", histograms) +
           paragraph(
               "Light of the volume over that of the referee, with bars of 3 standard errors. "
               "Rings are probes beyond 3 standard errors.") +
           element("div class=\"three\"", scatters);
}

std::string map_key(const std::string& darker, const std::string& brighter) {
    std::string key;
    const std::array<std::string, 7> texts{darker, "", "", "equal", "", "", brighter};
    for (size_t i = 0; i < texts.size(); ++i) {
        key += element(str_cat("span style=\"background:var(--d", i, ")\""), "") +
               escape_html(texts[i]);
    }
    return element("p class=\"key\"", key);
}

std::string maps(const VerifyReport& report) {
    std::string figures;
    if (!report.probes.empty()) {
        figures += element(
            "figure", probe_map(report) + map_key("z −4: volume darker", "+4: brighter") +
                          element("figcaption",
                                  "Probes from above, by the largest z of their channels. Ringed: "
                                  "beyond 3 standard errors. Point at one for its values."));
    }
    if (!report.places.empty()) {
        figures += element("figure",
                           place_map(report) + map_key("−40 % of the mean light", "+40 %") +
                               element("figcaption",
                                       "Places from above, by the difference of their luminance. "
                                       "Ringed: leaks, and places that see no probe of their "
                                       "cell."));
    }
    if (figures.empty()) return "";
    return heading("Where they differ") + element("div class=\"two\"", figures);
}

std::string worst_probes(const VerifyReport& report) {
    if (report.probes.empty()) return "";
    HtmlTable table("The ten probes with the largest z in a decided channel",
                    Cells{"Probe", "Position (m)", "Volume (lux)", "Referee (lux)", "z"});
    const auto size_of_z = [](const VerifyProbe& probe) { return std::abs(largest_z(probe)); };
    for (const VerifyProbe* probe : worst(report.probes, size_of_z)) {
        table.add_row(Cells{str_cat(probe->probe), metres(probe->position),
                            light_text(probe->volume), light_text(probe->traced.mean),
                            str_cat(fixed_point(probe->z.x, 2), ", ", fixed_point(probe->z.y, 2),
                                    ", ", fixed_point(probe->z.z, 2))});
    }
    return table.html();
}

std::string place_kind(const VerifyPlace& place) {
    std::string kind;
    const auto add = [&](bool applies, const char* name) {
        if (applies) kind += str_cat(kind.empty() ? "" : ", ", name);
    };
    add(place.is_leak, "too bright");
    add(place.is_dark, "too dark");
    add(place.is_unseen, "sees no probe");
    add(place.is_outside, "outside the probes");
    return kind;
}

std::string worst_places(const VerifyReport& report) {
    if (report.places.empty()) return "";
    HtmlTable table("The ten places with the largest difference of luminance",
                    Cells{"Position (m)", "Volume (lux)", "Referee (lux)", "Error (lux)",
                          "Difference / mean light", "Remark"});
    const auto size = [](const VerifyPlace& place) {
        return std::abs(luminance_difference(place));
    };
    const double mean = report.mean_light > 0.0 ? report.mean_light : 1.0;
    for (const VerifyPlace* place : worst(report.places, size)) {
        table.add_row(Cells{metres(place->position), light_text(place->answer),
                            light_text(place->traced.mean), light_text(place->traced.error),
                            percent_text(luminance_difference(*place) / mean), place_kind(*place)});
    }
    return table.html();
}

std::string coverage(const VerifyReport& report) {
    if (report.places.empty()) return "";
    HtmlTable table("Of all places", Cells{"Kind", "Share"});
    table.add_row(Cells{"leaks: much brighter than the referee", percent_text(report.leak_share)});
    table.add_row(Cells{"much darker than the referee", percent_text(report.dark_share)});
    table.add_row(Cells{"see no probe of their cell", percent_text(report.unseen_share)});
    table.add_row(Cells{"outside the hull of the probes", percent_text(report.outside_share)});
    const VerifyInterpolation& difference = report.interpolation;
    return heading("Leaks and coverage") +
           paragraph(str_cat("Interpolated light differs from traced light by ",
                             percent_text(difference.mean), " of the mean light (median ",
                             percent_text(difference.median), ", 95th percentile ",
                             percent_text(difference.p95), "; noise of the referee alone gives ",
                             percent_text(difference.noise), "). The mean light is ",
                             significant(report.mean_light), " lux of luminance.")) +
           table.html();
}

/// Standard error of both lights relative to the traced light, in the widest undecided channel.
double widest_bar(const VerifyProbe& probe) {
    double widest = 0.0;
    for (int i = 0; i < 3; ++i) {
        if (probe.is_decided[static_cast<size_t>(i)] || !(probe.traced.mean[i] > 0.0)) continue;
        widest = std::max(widest, std::hypot(probe.volume_error[i], probe.traced.error[i]) /
                                      probe.traced.mean[i]);
    }
    return widest;
}

std::string undecided(const VerifyReport& report) {
    const auto is_undecided = [](const VerifyProbe& probe) {
        return !std::ranges::all_of(probe.is_decided, [](bool decided) { return decided; });
    };
    std::vector<VerifyProbe> probes;
    std::ranges::copy_if(report.probes, std::back_inserter(probes), is_undecided);
    if (probes.empty()) return "";
    HtmlTable table(probes.size() > kWorstCount ? "The ten with the widest bars" : "All of them",
                    Cells{"Probe", "Position (m)", "Channels", "Widest standard error"});
    for (const VerifyProbe* probe : worst(probes, widest_bar)) {
        std::string channels;
        for (size_t i = 0; i < 3; ++i) {
            if (!probe->is_decided[i])
                channels += str_cat(channels.empty() ? "" : ", ", kChannelNames[i]);
        }
        table.add_row(Cells{str_cat(probe->probe), metres(probe->position), channels,
                            percent_text(widest_bar(*probe))});
    }
    return heading("Undecided probes") +
           paragraph(str_cat("At ", probes.size(),
                             " probes the combined standard error of a channel is above ",
                             percent_text(report.rules.widest_bar),
                             " of its light, or not known: no difference can be seen there. More "
                             "samples, of the bake or of the referee, decide them.")) +
           table.html();
}

std::string reproduce(const VerifyReport& report, const VerifyPageFacts& facts) {
    HtmlTable table("Versions and settings", Cells{"Name", "Value"});
    table.add_row(Cells{"program", facts.version});
    table.add_row(Cells{"referee", report.referee});
    table.add_row(Cells{"seed", str_cat(report.seed)});
    for (const auto& [name, value] : facts.settings) table.add_row(Cells{name, value});
    return heading("How to repeat it") + element("pre", escape_html(facts.command)) + table.html();
}

}  // namespace

std::string verify_page(const VerifyReport& report, const VerifyPageFacts& facts) {
    const std::string title = "Light of " + facts.volume_path;
    const std::string files = str_cat("Volume ", element("code", escape_html(facts.volume_path)),
                                      " in scene ", element("code", escape_html(facts.scene_path)));
    const std::string body = element("h1", escape_html(title)) + verdict(report, facts) +
                             element("p class=\"files\"", files) + compared(report) +
                             scene_pictures(facts) + probe_charts(report) + maps(report) +
                             heading("The largest differences") + worst_probes(report) +
                             worst_places(report) + coverage(report) + undecided(report) +
                             reproduce(report, facts);
    return str_cat(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
        "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n",
        element("title", escape_html(title)), element("style", kVerifyPageStyle),
        "</head>\n<body>\n", element("main", body), "</body>\n</html>\n");
}

}  // namespace tetralight
