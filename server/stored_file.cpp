// SPDX-License-Identifier: Apache-2.0
#include <tetralight/server/stored_file.h>

#include <algorithm>

#include <tetralight/base/str_cat.h>
#include <tetralight/base/utf8.h>
#include <tetralight/server/name_rules.h>
#include <tetralight/server/problem.h>

namespace tetralight::server {
namespace {

constexpr const char* kKindNames[] = {"scenes",  "skies",     "groups",
                                      "volumes", "lightmaps", "reflections"};
constexpr const char* kKindNouns[] = {"scene",  "sky",       "groups",
                                      "volume", "lightmaps", "reflections"};
constexpr const char* kExtensions[] = {".glb", ".hdr", ".json", ".probes", ".lightmaps", ".ktx2"};
constexpr size_t kIdLength = 64;
constexpr size_t kOldIdLength = 32;

}  // namespace

const char* name_of(Kind kind) {
    return kKindNames[static_cast<size_t>(kind)];
}

const char* noun_of(Kind kind) {
    return kKindNouns[static_cast<size_t>(kind)];
}

const char* extension_of(Kind kind) {
    return kExtensions[static_cast<size_t>(kind)];
}

std::optional<Kind> find_kind(const std::string& name) {
    const auto found = std::ranges::find(kKindNames, name);
    if (found == std::end(kKindNames)) return std::nullopt;
    return static_cast<Kind>(found - std::begin(kKindNames));
}

Json to_json(const StoredFile& file) {
    Json json{{"id", file.id},           {"name", file.names.empty() ? "" : *file.names.begin()},
              {"names", file.names},     {"bytes", file.bytes},
              {"created", file.created}, {"state", file.damage.empty() ? "ready" : "quarantined"}};
    if (!file.damage.empty()) json["damage"] = file.damage;
    return json;
}

Json to_json_with_facts(const StoredFile& file) {
    Json json = to_json(file);
    json["facts"] = object_in(file.facts);
    return json;
}

bool is_id(const std::string& text) {
    return (text.size() == kIdLength || text.size() == kOldIdLength) &&
           std::ranges::all_of(
               text, [](char c) { return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f'); });
}

std::string id_in_file_name(Kind kind, const std::string& name) {
    const std::string extension = extension_of(kind);
    if (!name.ends_with(extension)) return "";
    const std::string id = name.substr(0, name.size() - extension.size());
    return is_id(id) ? id : "";
}

void check_name(const std::string& name, const char* member) {
    constexpr size_t kLongest = 200;
    const bool is_plain = std::ranges::none_of(name, [](char c) {
        return static_cast<unsigned char>(c) < ' ' || c == '\x7f' || c == '/' || c == '\\';
    });
    const bool is_dots = name == "." || name == "..";
    const bool is_text = is_utf8(name) && !has_outer_space(name) && !has_hidden_character(name);
    if (is_plain && !is_dots && name.size() <= kLongest && is_text && !is_id(name)) return;
    throw Problem{400, "invalid_value",
                  str_cat(member,
                          ": a name has at most 200 bytes, no slashes, no control characters and "
                          "no invisible ones, no spaces at its ends, and is not an id"),
                  member, name.substr(0, kLongest)};
}

}  // namespace tetralight::server
