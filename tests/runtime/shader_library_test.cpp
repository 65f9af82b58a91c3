// SPDX-License-Identifier: Apache-2.0
#include <tetralight/runtime/shader_library.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>

namespace tetralight {
namespace {

constexpr ShaderFile kOwn{"lit.frag", "void main() {}\n"};

TEST(ShaderLibrary, HoldsTheFilesAsTheyAre) {
    const std::filesystem::path folder(TETRALIGHT_SOURCE_DIR "/runtime/shaders");
    for (const ShaderFile& file : shader_files()) {
        std::ifstream stream(folder / file.name);
        EXPECT_EQ(file.text, (std::ostringstream() << stream.rdbuf()).str()) << file.name;
    }
    const auto is_glsl = [](const auto& entry) { return entry.path().extension() == ".glsl"; };
    EXPECT_EQ(std::ranges::count_if(std::filesystem::directory_iterator(folder), is_glsl),
              static_cast<std::ptrdiff_t>(shader_files().size()));
}

TEST(ShaderLibrary, BeginsWithTheVersionAndEndsWithTheOwnText) {
    const auto source = compose_shader(ShaderLanguage::GlslEs300, {ShaderPart::Sh}, kOwn);
    EXPECT_TRUE(source.text.starts_with("#version 300 es\n#line 1 0\n"));
    EXPECT_TRUE(source.text.ends_with("#line 6001 3\nvoid main() {}\n"));
    EXPECT_EQ(source.files,
              (std::vector<std::string>{"begin.glsl", "sh.glsl", "end.glsl", "lit.frag"}));
}

TEST(ShaderLibrary, EveryFileStandsOnceWhateverPartsAreAskedFor) {
    const auto source = compose_shader(ShaderLanguage::Glsl450,
                                       {ShaderPart::Sh, ShaderPart::Query, ShaderPart::Sh}, kOwn);
    for (const std::string& file : source.files) {
        EXPECT_EQ(std::ranges::count(source.files, file), 1) << file;
    }
}

TEST(ShaderLibrary, HlslHasFilesByName) {
    const auto source = compose_shader(ShaderLanguage::Hlsl, {}, kOwn);
    EXPECT_EQ(source.text, "#define TETRALIGHT_HLSL\n#line 1 \"lit.frag\"\nvoid main() {}\n");
}

TEST(ShaderLibrary, QuotesNamesForHlsl) {
    const auto source =
        compose_shader(ShaderLanguage::Hlsl, {}, {"own \"q\"\\a\nb.hlsl", "void f() {}\n"});
    EXPECT_TRUE(source.text.ends_with("#line 1 \"own 'q'/a_b.hlsl\"\nvoid f() {}\n"));
}

TEST(ShaderLibrary, LineDirectivesOfTheOwnTextCountInItsFile) {
    const auto source = compose_shader(
        ShaderLanguage::Glsl450, {ShaderPart::Sh},
        {"lit.frag", "#line 100\nbroken\n # line 7 2\n#linear\n// #line 5\n#line x\n"});
    EXPECT_TRUE(
        source.text.ends_with("#line 6100\nbroken\n#line 6007 2\n#linear\n// #line 5\n#line x\n"));
    EXPECT_EQ(name_shader_lines(source, "ERROR: 0:6100: 'broken'"),
              "ERROR: lit.frag:100: 'broken'");
}

TEST(ShaderLibrary, NamesTheLinesOfEveryKindOfLog) {
    const auto source = compose_shader(ShaderLanguage::Glsl450, {ShaderPart::Sh}, kOwn);
    const char* log =
        "0:6012(7): error: `x' undeclared\n"  // Mesa
        "1(2040) : error C1008: undefined\n"  // NVIDIA
        "ERROR: 3:6002: 'x' : undeclared\n"   // glslang, ANGLE
        "WARNING: 0:1: something\n"
        "ERROR: 0:19002: far down in a long text\n"
        "ERROR: 1 compilation errors.  No code generated.\n"
        "linking failed";
    EXPECT_EQ(name_shader_lines(source, log),
              "lit.frag:12(7): error: `x' undeclared\n"
              "sh.glsl:40 : error C1008: undefined\n"
              "ERROR: lit.frag:2: 'x' : undeclared\n"
              "WARNING: begin.glsl:1: something\n"
              "ERROR: lit.frag:13002: far down in a long text\n"
              "ERROR: 1 compilation errors.  No code generated.\n"
              "linking failed");
    EXPECT_EQ(name_shader_lines(source, ""), "");
}

/// Every match of a pattern's first group in a text.
std::set<std::string> matches(const std::string& text, const char* pattern) {
    const std::regex regex(pattern);
    std::set<std::string> found;
    for (std::sregex_iterator match(text.begin(), text.end(), regex), end; match != end; ++match) {
        found.insert((*match)[1].str());
    }
    return found;
}

/// A file without its comments, preprocessor lines and the insides of its braces and parentheses.
/// The members of blocks without an instance name are global: their braces are kept open.
std::string top_level(std::string_view file) {
    std::string text = std::regex_replace(std::string(file), std::regex("//[^\n]*|#[^\n]*"), "");
    const std::regex block(R"(((?:uniform|buffer|cbuffer) [^;{]*)\{([^}]*)\};)");
    text = std::regex_replace(text, block, "$1; $2");
    std::string outside;
    int depth = 0;
    for (const char character : text) {
        const bool opens = character == '{' || character == '(' || character == '[';
        const bool closes = character == '}' || character == ')' || character == ']';
        if (closes) --depth;
        if (depth == 0) outside += character == '}' ? ';' : character;
        if (opens) ++depth;
    }
    return outside;
}

/// The names that a file gives to whoever includes it.
std::set<std::string> declared_names(std::string_view file) {
    std::set<std::string> names =
        matches(top_level(file), R"(\b([A-Za-z_]\w*)\s*(?:\(\)|\[\]|\{|;|=|: ))");
    names.merge(matches(std::string(file), R"(\n\s*#define (\w+))"));
    return names;
}

bool has_prefix(const std::string& name) {
    return name.starts_with("tetralight_") || name.starts_with("Tetralight") ||
           name.starts_with("TETRALIGHT_");
}

TEST(ShaderLibrary, EveryNameHasThePrefix) {
    std::set<std::string> bare;
    size_t name_count = 0;
    for (const ShaderFile& file : shader_files()) {
        for (const std::string& name : declared_names(file.text)) {
            ++name_count;
            if (!has_prefix(name)) bare.insert(name);
        }
    }
    // Words of GLSL, and those that begin.glsl lends to HLSL and end.glsl takes back.
    for (const std::string& word :
         matches(std::string(shader_files().back().text), R"(#undef ([a-z]\w*))")) {
        EXPECT_EQ(bare.erase(word), 1u) << word;
    }
    for (const char* word : {"layout", "int", "float", "sampler3D", "sampler2DArray"})
        bare.erase(word);
    EXPECT_EQ(bare, std::set<std::string>{});
    EXPECT_GT(name_count, 80u);
}

TEST(ShaderLibrary, PrefixTestSeesEveryKindOfName) {
    EXPECT_EQ(declared_names("// no_name\n#define MACRO(x) x\nTETRALIGHT_CONST uint limit = 4u;\n"
                             "struct Struct {\n    vec4 member;\n};\n"
                             "layout(binding = B) uniform Block {\n    Type global;\n};\n"
                             "StructuredBuffer<vec4> buffer : REGISTER(t, 1);\n"
                             "layout(std430) readonly buffer Cells {\n    uvec4 cells[];\n};\n"
                             "vec3 function(vec3 x) {\n    vec3 y = x;\n    return y;\n}\n"),
              (std::set<std::string>{"MACRO", "limit", "Struct", "Block", "global", "buffer",
                                     "REGISTER", "layout", "Cells", "cells", "function"}));
}

}  // namespace
}  // namespace tetralight
