// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <string>

#include <tetralight/server/json.h>

namespace tetralight::server {

/// What a stored file holds.
enum class Kind : uint8_t { Scenes, Skies, Groups, Volumes, Lightmaps, Reflections };

inline constexpr Kind kKinds[] = {Kind::Scenes,  Kind::Skies,     Kind::Groups,
                                  Kind::Volumes, Kind::Lightmaps, Kind::Reflections};

/// "scenes": its folder and its part of paths.
[[nodiscard]] const char* name_of(Kind kind);
/// "scene".
[[nodiscard]] const char* noun_of(Kind kind);
/// ".glb".
[[nodiscard]] const char* extension_of(Kind kind);
/// The kind of a `name_of`; nothing for any other text.
[[nodiscard]] std::optional<Kind> find_kind(const std::string& name);

/// One file of the store. Its bytes never change; its names can.
struct StoredFile {
    Kind kind = Kind::Scenes;
    /// The SHA-256 of its bytes, 64 hexadecimal digits; of files that versions before 0.1 stored,
    /// their XXH128, 32 digits.
    std::string id;
    /// Each leads to one file of its kind; the same bytes may have several.
    std::set<std::string> names;
    uint64_t bytes = 0;
    /// Seconds since 1970.
    double created = 0.0;
    /// What the upload was found to hold: a JSON object, kept as text because files are copied
    /// often.
    std::string facts = "{}";
    /// Why it cannot be used; empty if it can.
    std::string damage;
};

/// Without its facts.
[[nodiscard]] Json to_json(const StoredFile& file);
[[nodiscard]] Json to_json_with_facts(const StoredFile& file);

/// True if a text has the form of an id: 64 or 32 hexadecimal digits.
[[nodiscard]] bool is_id(const std::string& text);

/// The id in the name of a stored file: "ID.probes". Empty if no file of this kind has the name.
[[nodiscard]] std::string id_in_file_name(Kind kind, const std::string& name);

/// Throws a `Problem` unless the text can be a name: at most 200 bytes of UTF-8 without control
/// characters and slashes, and not an id. `member`: of the order that has it.
void check_name(const std::string& name, const char* member = "name");

}  // namespace tetralight::server
