// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>

#include <tetralight/server/bakes.h>
#include <tetralight/server/log.h>
#include <tetralight/server/metrics.h>
#include <tetralight/server/open_volumes.h>
#include <tetralight/server/router.h>
#include <tetralight/server/settings.h>
#include <tetralight/server/store.h>

namespace tetralight::server {

/// What handlers work with.
struct Service {
    const Settings& settings;
    Log& log;
    Metrics& metrics;
    Store& store;
    OpenVolumes& volumes;
    Bakes& bakes;
    /// No more requests are taken.
    std::atomic<bool> is_ending = false;
    /// Programs that work for requests are to end.
    std::atomic<bool> is_over = false;
    std::function<uint32_t()> connection_count = [] { return 0u; };
};

// The routes, by what they are about.
[[nodiscard]] std::vector<Route> file_routes(Service& service);
[[nodiscard]] std::vector<Route> query_routes(Service& service);
[[nodiscard]] std::vector<Route> bake_routes(Service& service);
[[nodiscard]] std::vector<Route> tool_routes(Service& service);
[[nodiscard]] std::vector<Route> system_routes(Service& service);

/// A file of the viewer's folder; without one, at `/`, how to get it.
[[nodiscard]] Response viewer_response(const Service& service, const std::string& path);

/// Runs a command for a request, for as long as the settings allow, the server lives and the client
/// waits. Throws a `Problem` in the words of the request.
Json run_tool(Service& service, const Request& request, const std::string& folder,
              std::vector<std::string> arguments);

/// The file that a member of a request refers to. Throws a `Problem` that names the member.
[[nodiscard]] StoredFile file_for(Service& service, Kind kind, const std::string& member,
                                  const std::string& reference);

/// Bytes of a file as a response, whole or by the ranges that the request asks for.
[[nodiscard]] Response bytes_response(const Request& request, const Body& body,
                                      const std::string& content_type, const std::string& tag);

/// The scene, the light that a request adds to it and the groups, linked into a folder as
/// "scene.glb", "sky.hdr" and "groups_0.json": files and options.
struct SceneInputs {
    std::vector<std::pair<StoredFile, std::string>> files;
    std::vector<std::string> arguments;
};

/// Reads "scene", "sky", "sky_intensity", "sky_rotation" and the sun of a request.
[[nodiscard]] SceneInputs read_scene(Service& service, Fields& fields);

}  // namespace tetralight::server
