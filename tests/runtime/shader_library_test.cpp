// SPDX-License-Identifier: Apache-2.0
#include <tetralight/runtime/shader_library.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
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

}  // namespace
}  // namespace tetralight
