// SPDX-License-Identifier: Apache-2.0
#include <tetralight/base/str_cat.h>
#include <tetralight/server/page.h>
#include <tetralight/server/problem.h>
#include <tetralight/server/quarantine.h>
#include <tetralight/server/service.h>

namespace tetralight::server {
namespace {

Json to_json(const Quarantined& entry) {
    Json json{{"name", entry.name}, {"bytes", entry.bytes}, {"time", entry.time}};
    json["kind"] = entry.kind ? Json(name_of(*entry.kind)) : Json();
    json["id"] = entry.kind ? Json(entry.id) : Json();
    return json;
}

/// `?limit=` and `?after=` a name.
Response list_entries(Service& service, const Request& request) {
    const Page page = page_of(request);
    Json entries = Json::array();
    Json next = nullptr;
    for (const Quarantined& entry : list_quarantine(service.store.quarantine_folder())) {
        if (entry.name <= page.after) continue;
        if (entries.size() == page.limit) {
            next = entries.back()["name"];
            break;
        }
        entries.push_back(to_json(entry));
    }
    return json_response({{"quarantine", entries}, {"next", next}});
}

/// Throws 404 if nothing has this name.
Quarantined find_entry(Service& service, const std::string& name) {
    auto entry = find_quarantined(service.store.quarantine_folder(), name);
    if (entry) return std::move(*entry);
    throw Problem{404, "not_found", "there is nothing of this name in the quarantine", "name",
                  name.substr(0, 200)};
}

/// Puts a file back where it was if its bytes have its id.
Response put_back(Service& service, const Request& request) {
    const std::string& name = request.captures[0];
    const Quarantined entry = find_entry(service, name);
    if (!entry.kind) {
        throw Problem{422, "bad_data", "only files of the store can be taken back", "name", name};
    }
    const StoredFile file =
        service.store.take_back(*entry.kind, entry.id, service.store.quarantine_folder() + name);
    service.volumes.forget(file.id);
    return json_response(to_json_with_facts(file));
}

/// Deletes a file or folder for ever.
Response remove(Service& service, const Request& request) {
    const Quarantined entry = find_entry(service, request.captures[0]);
    service.store.remove_quarantined(entry.name);
    return {.status = 204, .content_type = ""};
}

}  // namespace

std::vector<Route> quarantine_routes(Service& service) {
    return {{.method = "GET",
             .pattern = "/v1/quarantine",
             .handle = [&](Request& r) { return list_entries(service, r); },
             .parameters = {"after", "limit"},
             .run_on = Plan::RunOn::Storage},
            {.method = "DELETE",
             .pattern = "/v1/quarantine/{name}",
             .access = Access::Writes,
             .handle = [&](Request& r) { return remove(service, r); },
             .run_on = Plan::RunOn::Storage},
            {.method = "POST",
             .pattern = "/v1/quarantine/{name}/restore",
             .access = Access::Writes,
             .handle = [&](Request& r) { return put_back(service, r); },
             .run_on = Plan::RunOn::Storage}};
}

}  // namespace tetralight::server
