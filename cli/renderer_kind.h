// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace tetralight::cli {

/// In the order of the choices of `renderer`.
enum class RendererKind : uint8_t { Cpu, Gl };

}  // namespace tetralight::cli
