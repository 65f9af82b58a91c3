// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <vector>

// The shader library as text, so that a program needs no files at run time. The same files are
// installed in share/tetralight/shaders/.
//
//     const ShaderSource source =
//         compose_shader(ShaderLanguage::Glsl450, {ShaderPart::Query}, {"lit.frag", text});
//     compile(source.text);  // errors: name_shader_lines(source, log)

namespace tetralight {

/// A part of a shader and its name in error messages.
struct ShaderFile {
    std::string_view name;
    std::string_view text;
};

/// All files of the library, in a valid order of composition.
[[nodiscard]] std::span<const ShaderFile> shader_files() noexcept;

enum class ShaderLanguage {
    Glsl450,
    GlslEs300,  ///< reads the volume from textures instead of storage buffers
    Hlsl,
};

/// Parts of the library. Every part includes `Sh`. All names begin with `tetralight_`.
enum class ShaderPart {
    Sh,     ///< tetralight_sample_sh9, _sample_sh4, _probe_occlusion, _add_layer, _instance_normal
    Lppv,   ///< tetralight_sample_lppv_4, _sample_lppv_7, their atlas forms and occlusion
    Query,  ///< tetralight_locate, tetralight_interpolate, tetralight_blend
    Lightmap,    ///< tetralight_page_uv, tetralight_lightmap_irradiance, _lightmap_directional,
                 ///< _lightmap_shadow_mask, _lightmap_ambient_occlusion, _subtract_shadow
    Reflection,  ///< tetralight_sample_reflections, _project_on_box, _reflection_influence,
                 ///< _split_sum, _reflection_occlusion
};

/// A composed shader.
struct ShaderSource {
    std::string text;
    /// The names of its files, in order.
    std::vector<std::string> files;
};

/// Composes the version, the parts of the library and the shader's own text, each with a `#line`
/// directive. `own` must not contain a `#version`. In GLSL the lines of file i begin at 2000 i, so
/// that the line alone identifies the file: some drivers ignore the file number of `#line`.
[[nodiscard]] ShaderSource compose_shader(ShaderLanguage language,
                                          std::initializer_list<ShaderPart> parts,
                                          const ShaderFile& own);

/// A compiler's log with file names instead of numbers: `0:6012`, `0(6012)` and `ERROR: 0:6012`
/// (Mesa, NVIDIA, glslang and ANGLE) become `lit.frag:12`. Logs of HLSL compilers contain the
/// names.
[[nodiscard]] std::string name_shader_lines(const ShaderSource& source, std::string_view log);

}  // namespace tetralight
