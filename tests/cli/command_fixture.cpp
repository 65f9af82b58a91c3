// SPDX-License-Identifier: Apache-2.0
#include "tests/cli/command_fixture.h"

#include <stdlib.h>
#include <algorithm>
#include <fstream>
#include <regex>
#include <sstream>

namespace tetralight::test {
namespace {

namespace fs = std::filesystem;

std::string joined(const Arguments& arguments) {
    std::string line = "tetralight";
    for (const std::string& argument : arguments) line += " '" + argument + "'";
    return line;
}

}  // namespace

CommandFixture::CommandFixture() {
    std::string pattern = (fs::temp_directory_path() / "tetralight_cli_XXXXXX").string();
    folder_ = ::mkdtemp(pattern.data());
}

CommandFixture::~CommandFixture() {
    fs::remove_all(folder_);
}

CommandResult CommandFixture::run(const Arguments& arguments, const std::string& input) const {
    return run_command(folder_, arguments, input);
}

CommandResult CommandFixture::succeed(const Arguments& arguments, const std::string& input) const {
    CommandResult result = run(arguments, input);
    EXPECT_EQ(result.exit_code, 0) << joined(arguments) << "\n" << result.err;
    return result;
}

Json CommandFixture::run_json(Arguments arguments) const {
    arguments.emplace_back("--json");
    const std::string out = succeed(arguments).out;
    EXPECT_EQ(std::count(out.begin(), out.end(), '\n'), 1) << out;
    Json json = Json::parse(out, nullptr, false);
    EXPECT_TRUE(json.is_object()) << joined(arguments) << "\n" << out;
    return json;
}

std::string CommandFixture::fail(const Arguments& arguments, const std::string& input,
                                 int exit_code) const {
    SCOPED_TRACE(joined(arguments));
    const CommandResult result = run(arguments, input);
    EXPECT_EQ(result.exit_code, exit_code);
    EXPECT_EQ(result.out, "");
    // A slow machine gets lines of progress before.
    const std::string error = std::regex_replace(result.err, std::regex("Progress: [^\n]*\n"), "");
    EXPECT_TRUE(error.starts_with("tetralight: ")) << error;
    EXPECT_EQ(error.find('\n') + 1, error.size()) << "not one line: " << error;
    return error;
}

std::string CommandFixture::fail_and_keep(const std::string& output,
                                          const Arguments& arguments) const {
    const std::string old = "what was there before";
    write(output, old);
    const auto names_before = file_names();
    const std::string message = fail(arguments);
    EXPECT_EQ(read(output), old) << joined(arguments);
    EXPECT_EQ(file_names(), names_before) << joined(arguments);
    return message;
}

void CommandFixture::refuse_each(
    const std::vector<BadFile>& files, const std::string& output,
    const std::function<Arguments(const std::string& name)>& arguments) const {
    for (const BadFile& bad : files) {
        write(bad.name, bad.bytes);
        const Arguments words = arguments(bad.name);
        const std::string message = output.empty() ? fail(words) : fail_and_keep(output, words);
        EXPECT_TRUE(contains(message, bad.name + ": ")) << message;
        EXPECT_TRUE(contains(message, bad.reason)) << message;
    }
}

std::string CommandFixture::misuse(const Arguments& arguments) const {
    const CommandResult result = run(arguments);
    EXPECT_EQ(result.exit_code, 2) << joined(arguments) << "\n" << result.err;
    EXPECT_EQ(result.out, "") << joined(arguments);
    EXPECT_EQ(std::ranges::count(result.err, '\n'), 1) << result.err;
    EXPECT_TRUE(result.err.ends_with('\n')) << joined(arguments);
    return result.err;
}

void CommandFixture::bake_courtyard(const std::string& output) const {
    succeed({"bake", kCourtyard, "-o", output, "-s", "16"});
}

void CommandFixture::write(const std::string& name, const std::string& bytes) const {
    std::ofstream(folder_ / name, std::ios::binary) << bytes;
}

std::string CommandFixture::read(const std::string& name) const {
    std::ifstream stream(folder_ / name, std::ios::binary);
    EXPECT_TRUE(stream) << "cannot read " << name;
    std::ostringstream bytes;
    bytes << stream.rdbuf();
    return bytes.str();
}

std::string CommandFixture::path(const std::string& name) const {
    return (folder_ / name).string();
}

std::vector<std::string> CommandFixture::file_names() const {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder_)) {
        names.push_back(entry.path().filename().string());
    }
    std::sort(names.begin(), names.end());
    return names;
}

bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

}  // namespace tetralight::test
