// SPDX-License-Identifier: Apache-2.0
#include <tetralight/cli/job.h>

#include <iostream>
#include <iterator>
#include <span>

#include <tetralight/base/file.h>
#include <tetralight/base/json/json_text.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/base/suggest.h>
#include <tetralight/cli/common.h>
#include <tetralight/settings/read_values.h>

namespace tetralight::cli {
namespace {

Result<std::string> read_text(const std::string& path) {
    if (path == "-") return std::string(std::istreambuf_iterator<char>(std::cin), {});
    const auto bytes = read_file(path);
    if (!bytes) return bytes.error();
    return std::string(reinterpret_cast<const char*>(bytes->data()), bytes->size());
}

Result<const Command*> command_of(const Json& json) {
    const auto name = json.find("command");
    if (name == json.end() || !name->is_string()) {
        return Error{ErrorCode::InvalidArgument, "command", "", "command is required"};
    }
    const auto word = name->get<std::string>();
    if (word == "serve") {
        return Error{ErrorCode::InvalidArgument, "command", word, "command: serve cannot be a job"};
    }
    if (const Command* command = find_command(word)) return command;
    std::vector<std::string> names;
    for (const Command& known : commands()) names.emplace_back(known.table->command);
    return Error{ErrorCode::InvalidArgument, "command", word,
                 str_cat("command: there is no command \"", word, "\"", did_you_mean(word, names))};
}

/// The job was read from stdin, so that positions cannot come from there.
Status check_stdin_is_free(const Values& values) {
    if (&values.table() != &settings::kQuery) return Ok{};
    const std::string path = values.text("positions");
    if (!path.empty() && path != "-") return Ok{};
    return values.error("positions", "stdin holds the job; name a file");
}

}  // namespace

Result<Job> read_job(const std::string& path) {
    const auto text = read_text(path);
    if (!text) return text.error();
    if (const auto status = check_json_object(*text); !status) {
        return status.error().in(path == "-" ? "stdin" : path);
    }
    if (const auto key = find_duplicate_key(*text)) {
        return Error{ErrorCode::InvalidArgument, *key, "",
                     str_cat("\"", *key, "\" is given twice in one object")};
    }
    const Json json = Json::parse(*text);
    const auto command = command_of(json);
    if (!command) return command.error();
    const settings::Table& table = *(*command)->table;
    auto values = settings::values_from_json(table, json, settings::Access::Command, "command");
    if (!values) return values.error();
    if (path == "-") {
        if (const auto status = check_stdin_is_free(*values); !status) return status.error();
    }
    for (const char* name : {"json", "quiet"}) values->set(*table.find(name), true);
    return Job{*command, std::move(*values)};
}

}  // namespace tetralight::cli
