// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/build/merge_warnings.h>

#include <cstdio>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <tetralight/base/str_cat.h>
#include <tetralight/probes/build/detail/spread.h>

namespace tetralight {
namespace {

constexpr double kMeantFlat = 1e-6;

/// Two digits.
std::string rounded(double number) {
    char digits[32];
    std::snprintf(digits, sizeof digits, "%.2g", number);
    return digits;
}

void add_empty_groups(const MergedProbes& probes, std::vector<std::string>& warnings) {
    std::vector<bool> is_empty(probes.group_names.size(), true);
    for (const ProbeSource& source : probes.sources) is_empty[source.group] = false;
    for (size_t group = 0; group < is_empty.size(); ++group) {
        if (!is_empty[group]) continue;
        const std::string& warning = probes.group_empty_warnings[group];
        warnings.push_back(warning.empty()
                               ? str_cat("group \"", probes.group_names[group], "\" has no probes")
                               : warning);
    }
    if (!probes.sources.empty()) return;
    warnings.emplace_back("there are no probes: the volume answers with its ambient light alone");
}

void add_welded(const MergedProbes& probes, std::vector<std::string>& warnings) {
    if (2 * probes.welded_count() <= probes.sources.size()) return;
    warnings.push_back(str_cat(probes.welded_count(), " of ", probes.sources.size(),
                               " probes were welded to others (is a group there twice?)"));
}

double size_of(const std::vector<glm::dvec3>& positions) {
    glm::dvec3 low = positions[0], high = positions[0];
    for (const glm::dvec3& p : positions) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    return glm::distance(low, high);
}

void add_flat(const MergedProbes& probes, Dimension dimension, std::vector<std::string>& warnings) {
    const bool is_plane = dimension == Dimension::Plane;
    if (!is_plane && dimension != Dimension::Line) return;
    const double meant = kMeantFlat * size_of(probes.positions);
    if (detail::measure_spread(probes.positions, meant).dimension <= dimension) return;
    warnings.push_back(str_cat(probes.positions.size(), " probes lie ",
                               is_plane ? "in one plane" : "on one line", " (thinner than ",
                               rounded(2.0 * flat_tolerance(probes)), " m): the volume is made of ",
                               is_plane ? "triangles" : "segments"));
}

}  // namespace

std::vector<std::string> merge_warnings(const MergedProbes& probes, Dimension dimension) {
    std::vector<std::string> warnings;
    add_empty_groups(probes, warnings);
    add_welded(probes, warnings);
    add_flat(probes, dimension, warnings);
    return warnings;
}

}  // namespace tetralight
