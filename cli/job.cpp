// SPDX-License-Identifier: Apache-2.0
#include <tetralight/cli/job.h>

#include <iostream>
#include <iterator>
#include <span>

#include <tetralight/base/file.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/cli/common.h>
#include <tetralight/settings/read_values.h>
#include <tetralight/settings/suggest.h>

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
    const Command* command = find_command(word);
    if (command != nullptr && word != "serve") return command;
    std::vector<std::string> names;
    for (const Command& known : commands()) names.emplace_back(known.table->command);
    return Error{ErrorCode::InvalidArgument, "command", word,
                 str_cat("command: there is no command \"", word, "\"",
                         settings::did_you_mean(word, names))};
}

}  // namespace

Result<Job> read_job(const std::string& path) {
    const auto text = read_text(path);
    if (!text) return text.error();
    const Json json = Json::parse(*text, nullptr, false);
    if (!json.is_object()) {
        return Error{ErrorCode::InvalidArgument, path + ": is not a JSON object"};
    }
    const auto command = command_of(json);
    if (!command) return command.error();
    const settings::Table& table = *(*command)->table;
    auto values = settings::values_from_json(table, json, settings::Access::Command, "command");
    if (!values) return values.error();
    for (const char* name : {"json", "quiet"}) values->set(*table.find(name), true);
    return Job{*command, std::move(*values)};
}

}  // namespace tetralight::cli
