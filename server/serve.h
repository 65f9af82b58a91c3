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

/// Serves until SIGTERM or SIGINT, then finishes the requests in progress. Calls `is_listening`
/// with the port once it accepts requests. Returns an error if the folder or the address is not
/// usable.
[[nodiscard]] Status serve(const Settings& settings,
                           const std::function<void(uint16_t port)>& is_listening);

}  // namespace tetralight::server
