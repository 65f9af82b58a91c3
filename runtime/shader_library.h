// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <vector>

// The shader library as text, so that a program needs no files beside it. The same files are
// installed in share/tetralight/shaders/.
//
//     const ShaderSource source =
//         compose_shader(ShaderLanguage::Glsl450, {ShaderPart::Query}, {"lit.frag", text});
//     compile(source.text);  // errors: name_shader_lines(source, log)

namespace tetralight {

/// A piece of shader text and the name that errors give it.
struct ShaderFile {
    std::string_view name;
    std::string_view text;
};

/// All files of the library, in an order in which they can follow each other.
[[nodiscard]] std::span<const ShaderFile> shader_files() noexcept;

enum class ShaderLanguage {
    Glsl450,
    GlslEs300,  ///< the same with textures instead of storage buffers
    Hlsl,
};

/// What a shader uses of the library. Every part brings `Sh` along.
enum class ShaderPart {
    Sh,     ///< sample_sh9, sample_sh4, probe_occlusion, add_layer, instance_normal
    Lppv,   ///< sample_lppv_4, sample_lppv_7, their atlas forms and occlusion
    Query,  ///< locate, interpolate
};

/// A whole shader.
struct ShaderSource {
    std::string text;
    /// The names of its files in their order.
    std::vector<std::string> files;
};

/// Puts the version, the parts of the library and the shader's own text together, each with a
/// `#line` directive. `own` must not have a `#version` of its own.
[[nodiscard]] ShaderSource compose_shader(ShaderLanguage language,
                                          std::initializer_list<ShaderPart> parts,
                                          const ShaderFile& own);

/// A compiler's log with files by name: GLSL compilers know lines by number alone, and write
/// `0:6012`, `0(6012)` or `ERROR: 0:6012` (Mesa, NVIDIA, glslang and ANGLE), which becomes
/// `lit.frag:12`. Logs of HLSL have the names already.
[[nodiscard]] std::string name_shader_lines(const ShaderSource& source, std::string_view log);

}  // namespace tetralight
