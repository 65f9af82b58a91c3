// SPDX-License-Identifier: Apache-2.0
#include <tetralight/base/process/descriptor_io.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/lightmap/lightmap_file.h>
#include <tetralight/server/map_guard.h>
#include <tetralight/server/problem.h>
#include <tetralight/server/service.h>

namespace tetralight::server {
namespace {

/// The section of a file of this name. Throws 404 with the names of all sections if there is none.
template <class File>
std::span<const std::byte> find_section(const File& file, const std::string& name) {
    Json names = Json::array();
    for (const FileSection& section : file.sections()) {
        names.push_back(section.name);
        if (section.name != name) continue;
        if (const auto bytes = file.section_bytes(name, section.element_size)) return *bytes;
    }
    throw Problem{404, "not_found", "the file has no such section; it has " + dump(names),
                  "section", name.substr(0, 200)};
}

Response section_response(const Request& request, const Body& body, const std::string& id) {
    return bytes_response(request, body, "application/octet-stream",
                          id + "-" + request.captures[1]);
}

/// One section of a volume's file, byte for byte (docs/file_format.md).
Response volume_section(Service& service, const Request& request) {
    const StoredFile stored = service.store.get(Kind::Volumes, request.captures[0]);
    const auto volume = service.volumes.open(stored.id);
    const auto bytes = find_section(volume->file, request.captures[1]);
    Response response = section_response(request, {bytes, volume}, stored.id);
    response.is_intact = [volume] { return volume->is_whole(); };
    return response;
}

/// Lightmaps whose bytes had their id when they were opened.
struct OpenLightmaps {
    std::shared_ptr<const VerifiedFile> verified;
    LightmapFile file;
};

std::shared_ptr<const OpenLightmaps> open_lightmaps(Service& service, const std::string& id) {
    auto verified = service.files.open(Kind::Lightmaps, id);
    const std::string path = path_of_descriptor(verified->file);
    const ThreadGuard reading;
    auto file = open_lightmap_file_lazy(path);
    if (!verified->is_intact() || reading.is_damaged()) {
        throw Problem{503, "unavailable", "the file changed while it was read"};
    }
    if (file) {
        return std::make_shared<const OpenLightmaps>(
            OpenLightmaps{std::move(verified), std::move(*file)});
    }
    if (file.error().code != ErrorCode::Corrupt) {
        throw storage_problem(noun_of(Kind::Lightmaps), file.error(), path);
    }
    service.store.quarantine(Kind::Lightmaps, id, reason_without_path(file.error(), path));
    (void)service.store.get(Kind::Lightmaps, id);  // throws
    return nullptr;
}

/// The same of lightmaps.
Response lightmaps_section(Service& service, const Request& request) {
    const StoredFile stored = service.store.get(Kind::Lightmaps, request.captures[0]);
    const auto opened = open_lightmaps(service, stored.id);
    const auto bytes = find_section(opened->file, request.captures[1]);
    Response response = section_response(request, {bytes, opened}, stored.id);
    response.is_intact = [opened] { return opened->verified->is_intact(); };
    return response;
}

}  // namespace

std::vector<Route> section_routes(Service& service) {
    return {{.method = "GET",
             .pattern = "/v1/volumes/{volume}/sections/{section}",
             .handle = [&](Request& r) { return volume_section(service, r); }},
            {.method = "GET",
             .pattern = "/v1/lightmaps/{lightmaps}/sections/{section}",
             .handle = [&](Request& r) { return lightmaps_section(service, r); },
             .run_on = Plan::RunOn::Compute}};
}

}  // namespace tetralight::server
