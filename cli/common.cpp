// SPDX-License-Identifier: Apache-2.0
#include <tetralight/cli/common.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <glm/common.hpp>
#include <iostream>

#include <tetralight/base/error_text.h>
#include <tetralight/base/json/json_text.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/base/utf8.h>
#include <tetralight/cli/failure.h>

namespace tetralight::cli {
namespace {

std::string formatted(const char* format, double number, const char* unit) {
    char buffer[64];
    std::snprintf(buffer, sizeof buffer, format, number);
    return buffer + std::string(unit);
}

ReportCapture* g_capture = nullptr;

void print_to(std::ostream& stream, const CommonOptions& common, const Json& json,
              const std::string& text) {
    if (g_capture != nullptr) {
        g_capture->report = json;
    } else if (common.is_json) {
        stream << dump(with_warnings(json)) << '\n';
    } else if (!common.is_quiet) {
        stream << printable_lines(text) << '\n';
    }
}

}  // namespace

CommonOptions::CommonOptions(const Values& values)
    : is_json(values.flag("json")),
      is_quiet(values.flag("quiet")),
      thread_count(values.integer32("threads")) {}

void CommonOptions::print(const Json& json, const std::string& text) const {
    print_to(std::cout, *this, json, text);
}

void CommonOptions::report(const std::string& output, const Json& json,
                           const std::string& text) const {
    print_to(output == "-" ? std::cerr : std::cout, *this, json, text);
}

void CommonOptions::warn(const std::vector<std::string>& warnings) const {
    if (warnings_of_job() != nullptr) {
        warnings_of_job()->insert(warnings_of_job()->end(), warnings.begin(), warnings.end());
    } else if (!is_quiet) {
        for (const std::string& warning : warnings) {
            std::cerr << "warning: " << printable(warning) << '\n';
        }
    }
}

void CommonOptions::warn(const std::string& before, const Error& reason,
                         const std::string& after) const {
    warn({before + error_text(reason) + after});
}

void CommonOptions::warn_if_unlit(const std::string& path, const ProbeVolumeView& volume) const {
    if (volume.positions.empty() || !volume.irradiance.empty()) return;
    warn({path + ": the volume holds no light (it was not baked); probes light nothing"});
}

ReportCapture::ReportCapture() {
    g_capture = this;
}

ReportCapture::~ReportCapture() {
    g_capture = nullptr;
}

Json to_json(const glm::dvec3& value) {
    return Json::array({value.x, value.y, value.z});
}

std::string printable(const std::string& text) {
    return without_controls(text);
}

std::string printable_lines(std::string_view text) {
    std::string lines;
    while (!text.empty()) {
        const size_t length = std::min(text.find_first_of("\n\t"), text.size());
        lines += printable(std::string(text.substr(0, length)));
        if (length < text.size()) lines += text[length];
        text.remove_prefix(std::min(length + 1, text.size()));
    }
    return lines;
}

std::string dump(const Json& json, int indent) {
    return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

const char* name_of(Dimension dimension) {
    constexpr const char* kNames[] = {"none", "point", "line", "plane", "space"};
    return kNames[static_cast<size_t>(dimension)];
}

const char* cell_name(Dimension dimension) {
    constexpr const char* kNames[] = {"cell", "cell", "segment", "triangle", "tetrahedron"};
    return kNames[static_cast<size_t>(dimension)];
}

std::string cells_text(const ProbeVolumeView& volume) {
    constexpr const char* kMany[] = {"cells", "cells", "segments", "triangles", "tetrahedra"};
    const uint32_t count = volume.info.inner_cell_count;
    const Dimension dimension = volume.info.dimension;
    return grouped(count) + " " +
           (count == 1 ? cell_name(dimension) : kMany[static_cast<size_t>(dimension)]);
}

Box<glm::vec3> probe_bounds(const ProbeVolumeView& volume) {
    if (volume.positions.empty()) return {};
    auto bounds = Box<glm::vec3>::empty();
    for (const glm::vec3& p : volume.positions) bounds = union_of(bounds, p);
    return bounds;
}

std::string merged_text(uint64_t welded_count, uint64_t lattice_count, double largest_snap) {
    std::string line = grouped(welded_count) + " welded";
    if (lattice_count == 0) return line;
    line += ", " + counted(lattice_count, "lattice");
    return largest_snap > 0.0 ? line + formatted(" snapped by up to %.2g", largest_snap, " m")
                              : line;
}

Json made_with(const ProbeVolumeView& volume) {
    return check_json_object(volume.metadata) ? Json::parse(volume.metadata) : Json(nullptr);
}

Json counts(const ProbeVolumeView& volume) {
    const auto source_count = static_cast<size_t>(std::ranges::count_if(
        volume.sources, [](const ProbeSource& source) { return source.probe != kNoIndex; }));
    return {{"probes", volume.probe_count()},
            {"dimension", name_of(volume.info.dimension)},
            {"inner_cells", volume.info.inner_cell_count},
            {"hull_cells", volume.cells.size() - volume.info.inner_cell_count},
            {"groups", split_names(volume.group_names).size()},
            {"welded", source_count - std::min(source_count, volume.positions.size())}};
}

std::string duration(double seconds) {
    if (seconds >= 1.0) return formatted("%.1f", seconds, " s");
    if (seconds >= 1e-3) return formatted("%.1f", seconds * 1e3, " ms");
    return formatted("%.1f", seconds * 1e6, " µs");
}

std::string grouped(uint64_t number) {
    std::string digits = std::to_string(number);
    for (size_t end = digits.size(); end > 3; end -= 3) digits.insert(end - 3, 1, ' ');
    return digits;
}

std::string counted(uint64_t number, const std::string& noun) {
    return grouped(number) + " " + noun + (number == 1 ? "" : "s");
}

std::string magnitude(double number) {
    if (number >= 1e9) return formatted("%.2f", number / 1e9, " G");
    if (number >= 1e6) return formatted("%.2f", number / 1e6, " M");
    if (number >= 1e3) return formatted("%.2f", number / 1e3, " k");
    return formatted("%.0f", number, " ");
}

}  // namespace tetralight::cli
