// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>

#include <tetralight/render/gizmos.h>

namespace tetralight::cli {

/// What a picture shows of a volume: `--show`, `--ball-radius`, `--probe-color`.
struct GizmoOptions {
    GizmoSettings settings;

    void add_to(CLI::App& command);
};

}  // namespace tetralight::cli
