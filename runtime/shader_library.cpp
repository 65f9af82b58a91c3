// SPDX-License-Identifier: Apache-2.0
#include <tetralight/runtime/shader_library.h>

#include <algorithm>
#include <charconv>
#include <optional>

#include <tetralight/base/str_cat.h>

namespace tetralight {
namespace {

bool is_part_of(std::string_view file, ShaderPart part) {
    if (file == "begin.glsl" || file == "sh.glsl" || file == "end.glsl") return true;
    if (part == ShaderPart::Lppv) return file == "lppv.glsl";
    if (part == ShaderPart::Lightmap) return file == "lightmap.glsl";
    if (part == ShaderPart::Reflection) return file == "reflection.glsl";
    return part == ShaderPart::Query && file.starts_with("query");
}

/// The first line of a shader.
std::string_view head_of(ShaderLanguage language) {
    switch (language) {
        case ShaderLanguage::Glsl450:
            return "#version 450\n";
        case ShaderLanguage::GlslEs300:
            return "#version 300 es\n";
        case ShaderLanguage::Hlsl:
            return "#define TETRALIGHT_HLSL\n";
    }
    return {};
}

/// The lines of file i are numbered from this times i, so that the line identifies the file: some
/// drivers ignore the file number of `#line`. Only the last file, the shader's own text, may be
/// longer.
constexpr size_t kLineStep = 2000;

/// A name between quotes. Compilers treat a backslash in it differently.
std::string quoted(std::string_view name) {
    std::string quoted = "\"";
    for (const char character : name) {
        const bool is_control = static_cast<unsigned char>(character) < 0x20;
        quoted += character == '"' ? '\'' : character == '\\' ? '/' : is_control ? '_' : character;
    }
    return quoted + '"';
}

/// Parses a number at the front of `rest` and removes it.
std::optional<size_t> take_number(std::string_view& rest) {
    size_t number = 0;
    const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), number);
    if (error != std::errc{}) return std::nullopt;
    rest.remove_prefix(static_cast<size_t>(end - rest.data()));
    return number;
}

/// A line of a file. The number of a `#line` directive is shifted to the numbers of the file.
std::string shifted_line(std::string_view line, size_t first) {
    std::string_view rest = line;
    for (const std::string_view word : {"#", "line"}) {
        rest.remove_prefix(std::min(rest.find_first_not_of(" \t"), rest.size()));
        if (!rest.starts_with(word)) return std::string(line);
        rest.remove_prefix(word.size());
    }
    rest.remove_prefix(std::min(rest.find_first_not_of(" \t"), rest.size()));
    const auto number = take_number(rest);
    return number ? str_cat("#line ", first + *number, rest) : std::string(line);
}

void append_glsl(std::string& to, std::string_view from, size_t first) {
    while (!from.empty()) {
        const size_t end = std::min(from.find('\n'), from.size());
        to += shifted_line(from.substr(0, end), first);
        to += '\n';
        from.remove_prefix(std::min(end + 1, from.size()));
    }
}

void append(ShaderSource& source, ShaderLanguage language, const ShaderFile& file) {
    if (language == ShaderLanguage::Hlsl) {
        source.text += str_cat("#line 1 ", quoted(file.name), "\n", file.text);
        if (!file.text.ends_with('\n')) source.text += '\n';
    } else {
        const size_t place = source.files.size();
        source.text += str_cat("#line ", kLineStep * place + 1, " ", place, "\n");
        append_glsl(source.text, file.text, kLineStep * place);
    }
    source.files.emplace_back(file.name);
}

/// One line of a log; a position at its front gets the name of the file.
std::string name_line(const ShaderSource& source, std::string_view line) {
    std::string_view rest = line;
    for (const std::string_view kind : {"ERROR: ", "WARNING: "}) {
        if (rest.starts_with(kind)) rest.remove_prefix(kind.size());
    }
    const std::string_view kind = line.substr(0, line.size() - rest.size());
    if (!take_number(rest) || rest.empty() || source.files.empty()) return std::string(line);
    const bool is_bracket = rest.front() == '(';
    if (!is_bracket && rest.front() != ':') return std::string(line);
    rest.remove_prefix(1);
    const auto number = take_number(rest);
    if (!number) return std::string(line);
    if (is_bracket && rest.starts_with(')')) rest.remove_prefix(1);
    const size_t file = std::min(*number / kLineStep, source.files.size() - 1);
    return str_cat(kind, source.files[file], ':', *number - kLineStep * file, rest);
}

}  // namespace

ShaderSource compose_shader(ShaderLanguage language, std::initializer_list<ShaderPart> parts,
                            const ShaderFile& own) {
    ShaderSource source{std::string(head_of(language)), {}};
    for (const ShaderFile& file : shader_files()) {
        const bool is_used = std::any_of(parts.begin(), parts.end(), [&](ShaderPart part) {
            return is_part_of(file.name, part);
        });
        if (is_used) append(source, language, file);
    }
    append(source, language, own);
    return source;
}

std::string name_shader_lines(const ShaderSource& source, std::string_view log) {
    std::string named;
    while (!log.empty()) {
        const size_t end = std::min(log.find('\n'), log.size());
        named += name_line(source, log.substr(0, end));
        log.remove_prefix(end);
        if (log.empty()) break;
        named += '\n';
        log.remove_prefix(1);
    }
    return named;
}

}  // namespace tetralight
