// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include <tetralight/base/result.h>
#include <tetralight/server/settings.h>

// The HTTP service: scenes, bakes, volumes and queries (docs/server.md).
//
//     requests → HttpServer → Router → handlers → Store (files, SQLite), OpenVolumes → answers
//                                         └→ `tetralight` commands, Bakes

namespace tetralight::server {

/// Serves until SIGTERM or SIGINT, then answers what was begun. `is_listening` is called with the
/// port once requests are taken. Errors: the folder or the address cannot be used.
[[nodiscard]] Status serve(const Settings& settings,
                           const std::function<void(uint16_t port)>& is_listening);

}  // namespace tetralight::server
