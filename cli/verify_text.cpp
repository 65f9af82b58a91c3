// SPDX-License-Identifier: Apache-2.0
#include <tetralight/cli/verify_text.h>

#include <cstdio>

#include <tetralight/bake/all_bounces.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/cli/common.h>
#include <tetralight/cli/leak_report.h>
#include <tetralight/cli/table.h>

namespace tetralight::cli {
namespace {

std::string fixed(double number, const char* format) {
    char text[64];
    std::snprintf(text, sizeof text, format, number);
    return text;
}

std::string two_decimals(double share) {
    return fixed(100.0 * share, "%.2f %%");
}

std::vector<std::string> channel_row(const char* name, const VerifyChannel& channel) {
    if (channel.decided_count == 0)
        return {name, "0", "-", "-", "-", two_decimals(channel.undecided), "-"};
    return {name,
            grouped(channel.decided_count),
            two_decimals(channel.within_3_sigma),
            fixed(channel.mean_z, "%+.3f"),
            fixed(channel.rms_z, "%.3f"),
            two_decimals(channel.undecided),
            fixed(100.0 * channel.mean_difference, "%+.3f %%")};
}

std::string head_text(const VerifyReport& report) {
    const std::string bounces =
        report.bounces >= kAllBounces ? "all bounces" : counted(report.bounces, "bounce");
    std::string text =
        str_cat("by the ", report.referee, ", ", bounces, ", ",
                magnitude(static_cast<double>(report.sample_count)), "paths; ",
                counted(report.probes.size(), "probe"), " of ", grouped(report.volume_probe_count));
    if (report.excluded.total() > 0) {
        text += str_cat(" (left out: ", report.excluded.dilated, " dilated, ",
                        report.excluded.inside, " inside geometry, ", report.excluded.overridden,
                        " changed by adjustment volumes)");
    }
    if (report.untraced_count > 0) {
        text += str_cat("; no time for ", report.untraced_count, " probes and places");
    }
    return text + "\n";
}

std::string probes_text(const VerifyReport& report) {
    if (report.probes.empty()) return "";
    return aligned({{"mean irradiance", "decided", "within 3 σ", "mean z", "rms z", "undecided",
                     "difference"},
                    channel_row("  red", report.channels[0]),
                    channel_row("  green", report.channels[1]),
                    channel_row("  blue", report.channels[2])},
                   "lrrrrrr") +
           str_cat("difference over all normals, median of the probes: ",
                   two_decimals(report.directional_difference), "\n");
}

std::string places_text(const VerifyReport& report) {
    if (report.places.empty()) return "";
    const VerifyInterpolation& difference = report.interpolation;
    return str_cat("interpolated light at ", counted(report.places.size(), "free place"),
                   ": difference ", two_decimals(difference.mean), " of the mean light (median ",
                   two_decimals(difference.median), ", p95 ", two_decimals(difference.p95),
                   ", noise ", two_decimals(difference.noise), ")\n  leaks ",
                   two_decimals(report.leak_share), ", dark ", two_decimals(report.dark_share),
                   ", see no probe of their cell ", two_decimals(report.unseen_share),
                   ", outside the probes ", two_decimals(report.outside_share), "\n");
}

}  // namespace

std::string verify_text(const VerifyReport& report) {
    std::string text = head_text(report) + probes_text(report) + places_text(report);
    for (const std::string& note : report.notes) {
        append_wrapped(text, note, 0);
    }
    for (const VerifyFailure& failure : report.failures) {
        text += str_cat("failed: ", failure.message, "\n");
    }
    text.pop_back();
    return text;
}

}  // namespace tetralight::cli
