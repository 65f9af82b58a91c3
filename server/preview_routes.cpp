// SPDX-License-Identifier: Apache-2.0
// Looks at volumes and lightmaps that are being baked.
#include <fcntl.h>
#include <sys/stat.h>

#include <cerrno>
#include <charconv>
#include <utility>
#include <vector>

#include <tetralight/base/process/descriptor_io.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/base/system_error.h>
#include <tetralight/server/problem.h>
#include <tetralight/server/service.h>

namespace tetralight::server {
namespace {

Problem no_preview() {
    return {404, "not_found", "there is no preview yet", "bake"};
}

/// The bytes of a file that the running program of a bake writes. That program reads uploads: what
/// it writes may be anything. Throws a `Problem`: 404 if there is no such file, 413 if it is larger
/// than an upload may be.
std::vector<std::byte> read_result(const Service& service, const std::string& path) {
    // Not through links, and without waiting for pipes.
    const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK));
    if (!file && (errno == ENOENT || errno == ELOOP)) throw no_preview();
    if (!file) throw storage_problem("the preview", system_error(path, "open"), path);

    struct stat facts {};

    if (::fstat(file.value(), &facts) != 0 || !S_ISREG(facts.st_mode)) throw no_preview();
    const auto size = static_cast<uint64_t>(facts.st_size);
    if (size > service.settings.max_upload_bytes) {
        throw Problem{413, "too_large", str_cat("the preview has ", size, " bytes")};
    }
    std::vector<std::byte> bytes(size);
    const auto count = read_up_to(file, bytes);
    if (!count) throw storage_problem("the preview", system_error(path, "read"), path);
    bytes.resize(*count);
    return bytes;
}

Response preview_response(Service& service, const std::string& path, const char* content_type) {
    return {.content_type = content_type,
            .headers = {{"Cache-Control", "no-store"}},
            .body = read_result(service, path)};
}

/// The number of a page; the first one without a parameter.
uint32_t page_number(const Request& request) {
    const std::string* text = request.parameter("page");
    uint32_t page = 0;
    if (text == nullptr) return page;
    const char* end = text->data() + text->size();
    const auto [next, error] = std::from_chars(text->data(), end, page);
    if (error == std::errc{} && next == end) return page;
    throw Problem{400, "invalid_value", "page: must be a whole number", "page",
                  text->substr(0, 200)};
}

bool is_file(const std::string& path) {
    struct stat facts {};

    return ::lstat(path.c_str(), &facts) == 0 && S_ISREG(facts.st_mode);
}

/// The pictures of all pages; empty before the first preview. Of several pages each has a file,
/// `preview_0.png`; a single one is `preview.png`.
std::vector<std::string> page_names(Service& service, const std::string& bake) {
    const auto has = [&](const std::string& name) {
        return is_file(service.bakes.preview_path(bake, name));
    };
    if (has("preview.png")) return {"preview.png"};
    std::vector<std::string> names;
    for (uint32_t page = 0;; ++page) {
        std::string name = str_cat("preview_", page, ".png");
        if (!has(name)) return names;
        names.push_back(std::move(name));
    }
}

Response page_picture(Service& service, const Request& request) {
    const uint32_t page = page_number(request);
    const std::vector<std::string> names = page_names(service, request.captures[0]);
    if (names.empty()) throw no_preview();
    if (page < names.size()) {
        return preview_response(
            service, service.bakes.preview_path(request.captures[0], names[page]), "image/png");
    }
    throw Problem{404, "not_found",
                  str_cat("page: there is no page ", page, "; the preview has ", names.size(),
                          names.size() == 1 ? " page" : " pages", ", from 0 on"),
                  "page", str_cat(page)};
}

}  // namespace

std::vector<Route> preview_routes(Service& service) {
    const auto route = [&](const char* pattern, std::vector<std::string> parameters, auto handle) {
        return Route{.method = "GET",
                     .pattern = pattern,
                     .handle = handle,
                     .parameters = std::move(parameters),
                     .run_on = Plan::RunOn::Compute};
    };
    return {
        route("/v1/bakes/{bake}/preview", {"page"},
              [&](Request& r) { return page_picture(service, r); }),
        route("/v1/bakes/{bake}/preview/file", {},
              [&](Request& r) {
                  return preview_response(service, service.bakes.preview_file_path(r.captures[0]),
                                          "application/octet-stream");
              }),
        route("/v1/bakes/{bake}/preview/scene", {}, [&](Request& r) {
            return preview_response(service, service.bakes.preview_path(r.captures[0], "scene.glb"),
                                    "model/gltf-binary");
        })};
}

}  // namespace tetralight::server
