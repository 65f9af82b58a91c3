// SPDX-License-Identifier: Apache-2.0
#include <tetralight/server/tool_problem.h>

#include <algorithm>

#include <tetralight/base/str_cat.h>

namespace tetralight::server {
namespace {

/// A file or an option of a command, and what it stands for.
struct Meaning {
    std::string word;
    std::string member;
};

std::vector<Meaning> file_meanings(const Json& order) {
    std::vector<Meaning> all{
        {"scene.glb", "scene"},    {"volume.probes", "volume"}, {"sky.hdr", "sky"},
        {"other.probes", "blend"}, {"reuse.probes", "reuse"},   {"upload.glb", "body"},
        {"upload.hdr", "body"},    {"upload.json", "body"},     {"upload.probes", "body"},
        {"out.json", "result"},    {"out.probes", "result"},    {"out.png", "result"},
        {"out.vdb", "result"},     {"out.nvdb", "result"},      {"out.exr", "result"},
        {"out.dds", "result"},     {"out.ktx2", "result"}};
    const auto groups = order.find("groups");
    const size_t count = groups == order.end() ? 0 : groups->size();
    for (size_t i = 0; i < count; ++i) {
        all.push_back({str_cat("groups_", i, ".json"), str_cat("groups[", i, "]")});
    }
    return all;
}

void replace_all(std::string& text, std::string_view from, std::string_view to) {
    for (size_t at = text.find(from); at != std::string::npos; at = text.find(from, at)) {
        text.replace(at, from.size(), to);
        at += to.size();
    }
}

bool is_option_letter(char c) {
    return (c >= 'a' && c <= 'z') || c == '-';
}

/// "target_error" for "--target-error" at the beginning of a text; empty: none is there.
std::string member_at(std::string_view text) {
    constexpr std::string_view kDashes = "--";
    if (!text.starts_with(kDashes)) return "";
    text.remove_prefix(kDashes.size());
    const auto end = std::ranges::find_if_not(text, is_option_letter);
    std::string member(text.begin(), end);
    std::ranges::replace(member, '-', '_');
    return member;
}

std::string without_options(std::string_view message) {
    std::string out;
    for (size_t i = 0; i < message.size();) {
        const bool is_begin = i == 0 || !is_option_letter(message[i - 1]);
        const std::string member = is_begin ? member_at(message.substr(i)) : "";
        if (member.empty()) {
            out += message[i++];
        } else {
            out += member;
            i += member.size() + 2;
        }
    }
    return out;
}

/// Sets field and value when the message quotes a word that `value` has.
bool blame_quoted(const std::string& message, const std::string& member, const Json& value,
                  Problem& problem) {
    if (value.is_string() && message.find(dump(value)) != std::string::npos) {
        problem.field = member;
        problem.value = shown(value);
        return true;
    }
    if (value.is_array()) {
        for (size_t i = 0; i < value.size(); ++i) {
            if (blame_quoted(message, str_cat(member, "[", i, "]"), value[i], problem)) return true;
        }
    }
    if (value.is_object()) {
        for (const auto& [key, element] : value.items()) {
            if (message.find(dump(Json(key))) == std::string::npos) continue;
            problem.field = member + "." + key;
            problem.value = shown(element);
            return true;
        }
    }
    return false;
}

void blame_member(const Json& order, const std::string& member, Problem& problem) {
    problem.field = member;
    const size_t bracket = member.find('[');
    const auto found = order.find(member.substr(0, bracket));
    if (found == order.end()) return;
    const bool is_element = bracket != std::string::npos && found->is_array();
    problem.value = shown(is_element ? (*found)[std::stoul(member.substr(bracket + 1))] : *found);
}

/// What of the order is at fault: an option that the message begins with, a word that it quotes,
/// or a file.
void blame(const std::string& message, const Json& order, Problem& problem) {
    if (const std::string member = member_at(message); !member.empty()) {
        blame_member(order, member, problem);
        return;
    }
    for (const auto& [member, value] : order.items()) {
        // What names the files and the result is of no concern to the command.
        constexpr const char* kNames[] = {"name", "scene", "volume", "sky", "groups", "blend"};
        if (std::ranges::find(kNames, member) != std::end(kNames)) continue;
        if (blame_quoted(message, member, value, problem)) return;
    }
    for (const Meaning& meaning : file_meanings(order)) {
        if (!message.starts_with(meaning.word)) continue;
        blame_member(order, meaning.member, problem);
        return;
    }
}

Problem data_problem(const CommandResult& result, const Json& order) {
    Problem problem{422, "bad_data", in_words_of(order, result.message)};
    if (result.message.find("No space left") != std::string::npos) {
        problem.status = 507;
        problem.code = "disk_full";
    } else if (result.end == CommandResult::End::BadUsage) {
        problem.status = 400;
        problem.code = "invalid_value";
    }
    blame(result.message, order, problem);
    return problem;
}

}  // namespace

std::string in_words_of(const Json& order, const std::string& message) {
    std::string words = without_options(message);
    for (const Meaning& meaning : file_meanings(order)) {
        replace_all(words, meaning.word, meaning.member);
    }
    return words;
}

Problem tool_problem(const Settings& settings, const CommandResult& result,
                     const Request& request) {
    using End = CommandResult::End;
    switch (result.end) {
        case End::Fine:
        case End::BadData:
        case End::BadUsage:
            break;
        case End::TooSlow:
            return {504, "too_slow", str_cat("it takes longer than ", settings.tool_seconds, " s")};
        case End::Stopped:
            if (request.is_abandoned) return {499, "abandoned", "nobody waits for the answer"};
            return {503, "ending", "the server ends"};
        case End::Crashed:
            return {500, "tool_failed", result.message};
    }
    return data_problem(result, object_in(request.body));
}

}  // namespace tetralight::server
