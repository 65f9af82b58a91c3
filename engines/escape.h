// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

// Names of groups, layers and lights in the text formats of engines. Names may hold any bytes; what
// is not UTF-8 becomes U+FFFD. (JSON is written by a library.)

namespace tetralight {

/// A string of JSON, with its double quotes.
[[nodiscard]] std::string quoted_for_json(std::string_view text);

/// A string of Godot's text resources and of GDScript, with its double quotes.
[[nodiscard]] std::string quoted_for_godot(std::string_view text);

/// A string literal of C#, with its double quotes.
[[nodiscard]] std::string quoted_for_csharp(std::string_view text);

/// A string of RON, with its double quotes.
[[nodiscard]] std::string quoted_for_ron(std::string_view text);

/// Character data or an attribute of XML 1.0: & < > " ' become entities; characters that XML cannot
/// hold become U+FFFD.
[[nodiscard]] std::string escaped_for_xml(std::string_view text);

/// A field of CSV (RFC 4180), quoted where necessary. A field that a spreadsheet would take for a
/// formula (it begins with = + - @, a tab or a carriage return, blanks skipped) gets an apostrophe
/// before it.
[[nodiscard]] std::string escaped_for_csv(std::string_view text);

}  // namespace tetralight
