// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>

namespace tetralight::cli {

enum class RendererKind : uint8_t { Cpu, Gl };

/// Declares `--renderer`.
void add_renderer(CLI::App& command, RendererKind& renderer);

}  // namespace tetralight::cli
