// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/cli/bad_files.h"
#include "tests/cli/run_command.h"

namespace tetralight::test {

using Arguments = std::vector<std::string>;
using Json = nlohmann::json;

inline const std::string kCourtyard = TETRALIGHT_COURTYARD;

/// A scene without anything in it: probes see the sky alone.
inline const std::string kEmptyScene =
    R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{}]})";

/// Five probes, of which four span a tetrahedron around (1, 1, 1).
inline const std::string kFiveProbes =
    R"({"groups": [{"name": "five", "positions":
        [[0, 0, 0], [8, 0, 0], [0, 8, 0], [0, 0, 8], [1, 1, 1]]}]})";

/// Runs commands in a folder of its own, which goes away with the test.
class CommandFixture : public testing::Test {
  protected:
    CommandFixture();
    ~CommandFixture() override;

    [[nodiscard]] CommandResult run(const Arguments& arguments,
                                    const std::string& input = "") const;

    /// Runs a command that has to succeed.
    CommandResult succeed(const Arguments& arguments, const std::string& input = "") const;

    /// The one JSON object on stdout of a command that has to succeed.
    [[nodiscard]] Json run_json(Arguments arguments) const;

    /// Runs a command that has to fail with an exit code, nothing on stdout and one line on stderr.
    /// Returns that line.
    std::string fail(const Arguments& arguments, const std::string& input = "",
                     int exit_code = 1) const;

    /// The same, and what the folder held before, an old `output` among it, stays as it was.
    std::string fail_and_keep(const std::string& output, const Arguments& arguments) const;

    /// Holds that a command refuses every bad file by its name and with the reason. An `output`
    /// that is not empty has to stay as it was.
    void refuse_each(const std::vector<BadFile>& files, const std::string& output,
                     const std::function<Arguments(const std::string& name)>& arguments) const;

    /// Runs a command that has to be refused as wrong usage: exit code 2, nothing on stdout and one
    /// line on stderr. Returns that line.
    std::string misuse(const Arguments& arguments) const;

    /// Writes a small baked volume of the courtyard.
    void bake_courtyard(const std::string& output) const;

    void write(const std::string& name, const std::string& bytes) const;
    [[nodiscard]] std::string read(const std::string& name) const;
    [[nodiscard]] std::string path(const std::string& name) const;
    [[nodiscard]] std::vector<std::string> file_names() const;

    [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }

  private:
    std::filesystem::path folder_;
};

[[nodiscard]] bool contains(const std::string& text, const std::string& part);

}  // namespace tetralight::test
