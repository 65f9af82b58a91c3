// SPDX-License-Identifier: Apache-2.0
#include "tests/repository/header_names.h"

#include <algorithm>
#include <array>
#include <regex>
#include <span>

#include "tests/repository/source_files.h"

namespace tetralight {
namespace {

using Tokens = std::span<const std::string>;

std::vector<std::string> tokens_of(const std::string& header_text) {
    const std::regex directive("^[ \t]*#(?:[^\n]*\\\\\n)*[^\n]*", std::regex::multiline);
    const std::string text =
        std::regex_replace(without_comments_and_strings(header_text), directive, "");
    const std::regex token("[A-Za-z_][A-Za-z_0-9]*|[0-9][A-Za-z_0-9.']*|::|\\S");
    std::vector<std::string> tokens;
    for (std::sregex_iterator it(text.begin(), text.end(), token), end; it != end; ++it) {
        tokens.push_back(it->str());
    }
    return tokens;
}

bool is_identifier(const std::string& token) {
    return std::isalpha(static_cast<unsigned char>(token[0])) || token[0] == '_';
}

bool contains(Tokens tokens, const std::string& token) {
    return std::ranges::find(tokens, token) != tokens.end();
}

/// The index after the bracket that closes the one at `open`.
size_t after_closing(Tokens tokens, size_t open, const std::string& opening,
                     const std::string& closing) {
    int depth = 0;
    for (size_t i = open; i < tokens.size(); ++i) {
        if (tokens[i] == opening) ++depth;
        if (tokens[i] == closing && --depth == 0) return i + 1;
    }
    return tokens.size();
}

/// A declaration without its template header, attributes and template arguments.
std::vector<std::string> plain_declaration(Tokens tokens) {
    std::vector<std::string> plain;
    for (size_t i = 0; i < tokens.size();) {
        const bool is_alignas = tokens[i] == "alignas" || tokens[i] == "requires";
        if (tokens[i] == "operator") return {};
        if (tokens[i] == "=") {
            plain.insert(plain.end(), tokens.begin() + static_cast<std::ptrdiff_t>(i),
                         tokens.end());
            break;
        }
        if (tokens[i] == "<") {
            i = after_closing(tokens, i, "<", ">");
        } else if (tokens[i] == "[") {
            i = after_closing(tokens, i, "[", "]");
        } else if (is_alignas && i + 1 < tokens.size() && tokens[i + 1] == "(") {
            i = after_closing(tokens, i + 1, "(", ")");
        } else {
            if (tokens[i] != "template") plain.push_back(tokens[i]);
            ++i;
        }
    }
    return plain;
}

/// The name of the type that a declaration defines; empty if it defines none.
std::string type_name(Tokens plain) {
    constexpr std::array kKeys{"struct", "class", "union", "enum"};
    for (size_t i = 0; i < plain.size(); ++i) {
        if (plain[i] == "(" || plain[i] == "=") return {};
        if (std::ranges::find(kKeys, plain[i]) == kKeys.end()) continue;
        if (i + 1 < plain.size() && plain[i + 1] == "class") ++i;
        return i + 1 < plain.size() && is_identifier(plain[i + 1]) ? plain[i + 1] : std::string();
    }
    return {};
}

/// The index of the first of `markers`; the number of tokens if there is none.
size_t find_first(Tokens plain, std::initializer_list<std::string> markers) {
    const auto found = std::ranges::find_first_of(plain, markers);
    return static_cast<size_t>(found - plain.begin());
}

/// The identifier before an index; empty if there is none.
std::string name_before(Tokens plain, size_t index) {
    const bool is_name = index > 0 && index < plain.size() && is_identifier(plain[index - 1]);
    return is_name ? plain[index - 1] : std::string();
}

/// The types of a parameter list, so that overloads differ: "(int,const Box&)".
std::string parameter_types(Tokens written) {
    const size_t open = find_first(written, {"("});
    const Tokens list = written.subspan(open, after_closing(written, open, "(", ")") - open);
    std::string types;
    bool is_default = false;
    for (size_t i = 0; i < list.size(); ++i) {
        const bool ends_parameter = list[i] == "," || i + 1 == list.size();
        if (list[i] == "=") is_default = true;
        if (ends_parameter) is_default = false;
        const bool is_last = i + 1 < list.size() &&
                             (list[i + 1] == "," || list[i + 1] == "=" || i + 2 == list.size());
        const bool is_name = i > 1 && is_last && is_identifier(list[i]) && list[i - 1] != "," &&
                             list[i - 1] != "::" && list[i - 1] != "const";
        if (!is_default && !is_name) types += list[i];
    }
    return types;
}

/// Walks the declarations of a header.
class NameScanner {
  public:
    explicit NameScanner(Tokens tokens) : tokens_(tokens) {}

    std::vector<std::string> scan() {
        scan_scope("");
        return std::move(names_);
    }

  private:
    void scan_scope(const std::string& scope) {
        while (at_ < tokens_.size() && tokens_[at_] != "}") scan_declaration(scope);
        ++at_;
    }

    void scan_declaration(const std::string& scope) {
        const size_t begin = at_;
        while (at_ < tokens_.size() && tokens_[at_] != ";" && tokens_[at_] != "{") {
            at_ = tokens_[at_] == "(" ? after_closing(tokens_, at_, "(", ")") : at_ + 1;
        }
        const Tokens written = tokens_.subspan(begin, at_ - begin);
        const bool has_braces = at_ < tokens_.size() && tokens_[at_] == "{";
        if (has_braces && !written.empty() && is_scope(written)) return enter(written, scope);
        std::vector<std::string> plain = plain_declaration(written);
        plain.push_back(has_braces ? "{" : ";");
        const size_t marker = find_first(plain, {"(", "=", "{"});
        if (!has_braces) {
            ++at_;
            const bool has_value = marker < plain.size() && plain[marker] == "=";
            if (has_value) record(scope, name_before(plain, marker));
            return;
        }
        at_ = after_closing(tokens_, at_, "{", "}");
        const std::string type = type_name(plain);
        const bool is_function = type.empty() && (plain.size() == 1 || plain[marker] == "(");
        const std::string name = type.empty() ? name_before(plain, marker) : type;
        const bool has_types = is_function && !name.empty();
        record(scope, has_types ? name + parameter_types(written) : name);
        while (!is_function && at_ < tokens_.size() && tokens_[at_++] != ";") {
        }
    }

    static bool is_scope(Tokens written) {
        return contains(written, "namespace") || written.back() == "extern";
    }

    void enter(Tokens written, const std::string& scope) {
        std::string inner = scope;
        for (const std::string& token : written) {
            const bool is_name = token != "inline" && token != "namespace" && token != "extern";
            if (is_name && is_identifier(token)) inner += token + "::";
        }
        ++at_;
        scan_scope(inner);
    }

    void record(const std::string& scope, const std::string& name) {
        if (!name.empty()) names_.push_back(scope + name);
    }

    Tokens tokens_;
    size_t at_ = 0;
    std::vector<std::string> names_;
};

}  // namespace

std::vector<std::string> names_defined_in(const std::string& header_text) {
    const std::vector<std::string> tokens = tokens_of(header_text);
    return NameScanner(tokens).scan();
}

}  // namespace tetralight
