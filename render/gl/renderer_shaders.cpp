// SPDX-License-Identifier: Apache-2.0
#include <tetralight/render/gl/renderer_shaders.h>

#include <array>
#include <string>

#include <tetralight/render/gl/detail/shader_texts.h>
#include <tetralight/render/gl/gl.h>

namespace tetralight {
namespace {

struct StageText {
    const char* name;
    std::initializer_list<ShaderPart> parts;
    std::string text;
};

Result<ShaderProgram> make_program(const StageText& vertex, const StageText& fragment) {
    const ShaderSource sources[] = {
        compose_shader(ShaderLanguage::Glsl450, vertex.parts, {vertex.name, vertex.text}),
        compose_shader(ShaderLanguage::Glsl450, fragment.parts, {fragment.name, fragment.text})};
    const std::array stages{ShaderStage{GL_VERTEX_SHADER, sources[0]},
                            ShaderStage{GL_FRAGMENT_SHADER, sources[1]}};
    return ShaderProgram::create(stages);
}

}  // namespace

Result<RendererShaders> make_renderer_shaders() {
    const std::string structs = detail::kInstanceText, surface = detail::kSurfaceInputText,
                      frame = detail::kFrameText;
    const StageText vertex{"surface.vert",
                           {ShaderPart::Sh, ShaderPart::Lightmap},
                           structs + detail::kSurfaceVertexText};
    auto depth = make_program(vertex, {"depth.frag", {ShaderPart::Sh}, detail::kDepthText});
    if (!depth) return depth.error();
    auto masked = make_program(
        vertex,
        {"masked_depth.frag", {ShaderPart::Sh}, structs + surface + detail::kMaskedDepthText});
    if (!masked) return masked.error();
    auto lit = make_program(
        vertex,
        {"lit.frag",
         {ShaderPart::Query, ShaderPart::Lppv, ShaderPart::Lightmap, ShaderPart::Reflection},
         structs + surface + frame + detail::kReflectionText + detail::kLitText});
    if (!lit) return lit.error();
    auto sky = make_program({"sky.vert", {ShaderPart::Sh}, detail::kSkyVertexText},
                            {"sky.frag", {ShaderPart::Sh}, frame + detail::kSkyText});
    if (!sky) return sky.error();
    return RendererShaders{std::move(*depth), std::move(*masked), std::move(*lit), std::move(*sky)};
}

}  // namespace tetralight
