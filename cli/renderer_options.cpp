// SPDX-License-Identifier: Apache-2.0
#include <tetralight/cli/renderer_options.h>

#include <tetralight/cli/choice.h>

namespace tetralight::cli {

void add_renderer(CLI::App& command, RendererKind& renderer) {
    add_choice(command, "--renderer", renderer,
               {{"cpu", RendererKind::Cpu}, {"gl", RendererKind::Gl}},
               "cpu = by rays, the same bytes everywhere; gl = by OpenGL 4.5, faster on a GPU "
               "(drivers in software are warned of); without OpenGL it warns and takes cpu");
}

}  // namespace tetralight::cli
