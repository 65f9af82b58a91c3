// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "base/result.h"
#include "cli/commands.h"
#include "probes/probe_group.h"
#include "probes/probe_volume.h"

namespace tetralight::cli {

using Json = nlohmann::ordered_json;

/// Options that every subcommand has.
struct CommonOptions {
    bool is_json = false;
    bool is_quiet = false;
    uint32_t thread_count = 0;

    void add_to(CLI::App& command);

    /// The result on stdout: as one JSON object, or as `text` unless quiet.
    void print(const Json& json, const std::string& text) const;
    /// The same after `output` was written; on stderr when the output itself went to stdout (`-`).
    void report(const std::string& output, const Json& json, const std::string& text) const;
    /// Lines on stderr, unless quiet.
    void warn(const std::vector<std::string>& warnings) const;
};

/// Declares a subcommand: its options live in an `Options` with `add_to(command)` and `run()`.
template <class Options>
CLI::App& add_command(CLI::App& app, Run& run, const char* name, const char* description,
                      const char* example) {
    CLI::App* command = app.add_subcommand(name, description);
    command->footer(std::string("Example:\n  ") + example);
    auto options = std::make_shared<Options>();
    options->add_to(*command);
    command->callback([&run, options] { run = [options] { return options->run(); }; });
    return *command;
}

/// One number, or several with commas between, each from `low` to `high`. Unlike CLI::Range it
/// refuses NaN.
[[nodiscard]] CLI::Validator numbers_in(double low, double high);

/// An option whose value is three finite numbers with commas between: `--name 1,2,3`.
CLI::Option* add_vec3(CLI::App& command, const std::string& name, glm::dvec3& value,
                      const std::string& help);

/// The same, and a single number stands for all three.
CLI::Option* add_vec3_or_number(CLI::App& command, const std::string& name, glm::dvec3& value,
                                const std::string& help);

/// Three numbers with commas between, or none.
[[nodiscard]] std::optional<glm::dvec3> parse_vec3(const std::string& text);

/// Reads probe groups: a JSON group file, or the groups of a glTF scene.
[[nodiscard]] Result<std::vector<ProbeGroup>> read_groups(const std::string& path);

/// Reads every file and joins the lists. An error when there is no group in a file.
[[nodiscard]] Result<std::vector<ProbeGroup>> read_groups(const std::vector<std::string>& paths);

/// Says before a long job, not after it, that the output cannot be written, or that it would take
/// the place of one of the inputs.
[[nodiscard]] Status check_output(const std::string& path, const std::vector<std::string>& inputs);

[[nodiscard]] Json to_json(const glm::dvec3& value);
/// Text for a terminal: one line, control characters shown as '?'.
[[nodiscard]] std::string printable(std::string text);
/// JSON on one line, or indented. Bytes that are not UTF-8, in a path for example, are replaced.
[[nodiscard]] std::string dump(const Json& json, int indent = -1);
/// "space", "plane", "line", "point", "none".
[[nodiscard]] const char* name_of(Dimension dimension);
/// "1 347 tetrahedra", "12 triangles".
[[nodiscard]] std::string cells_text(const ProbeVolumeView& volume);
/// What a volume holds, in numbers.
[[nodiscard]] Json counts(const ProbeVolumeView& volume);

/// "12.3 s", "4.56 ms".
[[nodiscard]] std::string duration(double seconds);
/// "1 234 567" with thin grouping.
[[nodiscard]] std::string grouped(uint64_t number);
/// "3.4 M", "512 ": a unit can follow.
[[nodiscard]] std::string magnitude(double number);

}  // namespace tetralight::cli
