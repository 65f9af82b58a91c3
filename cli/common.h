// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include <tetralight/base/box.h>
#include <tetralight/base/result.h>
#include <tetralight/cli/values.h>
#include <tetralight/probes/probe_volume.h>

namespace tetralight::cli {

using Json = nlohmann::ordered_json;

/// Options that every command has.
struct CommonOptions {
    bool is_json = false;
    bool is_quiet = false;
    uint32_t thread_count = 0;

    explicit CommonOptions(const Values& values);

    /// The result on stdout: as one JSON object, or as `text` unless quiet.
    void print(const Json& json, const std::string& text) const;
    /// The same after `output` was written; on stderr when the output itself went to stdout (`-`).
    void report(const std::string& output, const Json& json, const std::string& text) const;
    /// Lines on stderr, unless quiet; members of the result in a job.
    void warn(const std::vector<std::string>& warnings) const;
    /// "BEFORE: reasonAFTER".
    void warn(const std::string& before, const Error& reason, const std::string& after) const;
    /// Warns that a volume was never baked, which explains black answers.
    void warn_if_unlit(const std::string& path, const ProbeVolumeView& volume) const;
};

/// While it lives, the result of a command that runs within another one is kept here instead of
/// printed. At most one at a time.
class ReportCapture {
  public:
    ReportCapture();
    ~ReportCapture();
    ReportCapture(const ReportCapture&) = delete;
    ReportCapture& operator=(const ReportCapture&) = delete;

    Json report = Json::object();
};

[[nodiscard]] Json to_json(const glm::dvec3& value);
/// Text for a terminal: one line, control characters shown as '?'.
[[nodiscard]] std::string printable(const std::string& text);

/// The same for each line of a text; tabs stay.
[[nodiscard]] std::string printable_lines(std::string_view text);
/// JSON on one line, or indented. Bytes that are not UTF-8, in a path for example, are replaced.
[[nodiscard]] std::string dump(const Json& json, int indent = -1);
/// "space", "plane", "line", "point", "none".
[[nodiscard]] const char* name_of(Dimension dimension);
/// "tetrahedron", "triangle", "segment", "cell": an inner cell of such a volume.
[[nodiscard]] const char* cell_name(Dimension dimension);
/// "1 347 tetrahedra", "1 triangle".
[[nodiscard]] std::string cells_text(const ProbeVolumeView& volume);

/// The box around a volume's probes, relative to its local origin; a point without probes.
[[nodiscard]] Box<glm::vec3> probe_bounds(const ProbeVolumeView& volume);
/// "3 welded", "3 welded, 2 lattices", "3 welded, 2 lattices snapped by up to 1e-07 m".
[[nodiscard]] std::string merged_text(uint64_t welded_count, uint64_t lattice_count,
                                      double largest_snap);
/// How a volume was made: the JSON object of its metadata; null if it has none.
[[nodiscard]] Json made_with(const ProbeVolumeView& volume);
/// What a volume holds, in numbers.
[[nodiscard]] Json counts(const ProbeVolumeView& volume);

/// "12.3 s", "4.56 ms".
[[nodiscard]] std::string duration(double seconds);
/// "1 234 567" with thin grouping.
[[nodiscard]] std::string grouped(uint64_t number);
/// "1 probe", "2 probes".
[[nodiscard]] std::string counted(uint64_t number, const std::string& noun);
/// "3.4 M", "512 ": a unit can follow.
[[nodiscard]] std::string magnitude(double number);

}  // namespace tetralight::cli
