// SPDX-License-Identifier: Apache-2.0
#include <limits>
#include <map>

#include <tetralight/base/str_cat.h>
#include <tetralight/batch/limits.h>
#include <tetralight/server/order.h>
#include <tetralight/server/page.h>
#include <tetralight/server/problem.h>
#include <tetralight/server/service.h>

namespace tetralight::server {
namespace {

int64_t read_priority(Fields& fields) {
    constexpr int64_t kMost = 100;
    const Json* priority = fields.find("priority");
    if (priority == nullptr) return 0;
    const bool is_right =
        priority->is_number_integer() && *priority <= kMost && *priority >= -kMost;
    if (!is_right) refuse("priority", *priority, "a whole number from -100 to 100");
    return priority->get<int64_t>();
}

/// What the report of its batch compares the bake with.
void check_limits(Fields& fields) {
    const Json* limits = fields.find("limits");
    if (limits == nullptr) return;
    const auto read = read_limits(*limits);
    if (!read)
        throw Problem{400, "invalid_value", detail_of(read.error()), "limits", shown(*limits)};
    if (fields.text("batch").empty())
        throw Problem{400, "missing_value", "limits need a batch, whose report compares them",
                      "batch"};
}

BakeOrder read_order(Service& service, Kind kind, const Json& json) {
    const settings::Table& table = bake_table(kind);
    check_order(table, json, "name priority batch limits");
    Fields fields(json);
    BakeOrder order{.kind = kind,
                    .request = json,
                    .name = fields.text("name"),
                    .priority = read_priority(fields),
                    .batch = fields.text("batch"),
                    .inputs = order_files(service.store, table, json)};
    check_name(order.name);
    check_name(order.batch, "batch");
    check_limits(fields);
    return order;
}

/// Lets the command read the settings and the scene, so that an order that cannot be baked is
/// refused at once.
void check(Service& service, const Request& request, const BakeOrder& order) {
    const WorkFolder folder = service.store.make_work_folder();
    for (const auto& [file, name] : order.inputs) service.store.link(file, folder.file(name));
    const settings::Table& table = bake_table(order.kind);
    Job job{.command = std::string(table.command),
            .settings = job_settings(table, order.request),
            .folder = folder.path()};
    job.settings["explain"] = true;
    (void)run_tool(service, request, order.request, std::move(job));
}

Response submit(Service& service, Kind kind, const Request& request) {
    const BakeOrder order = read_order(service, kind, parse_object(request.body));
    check(service, request, order);
    const Json bake = service.bakes.submit(order);
    Response response = json_response(bake, 202);
    response.headers.emplace_back("Location", "/v1/bakes/" + bake["id"].get<std::string>());
    return response;
}

/// Newest first. `?limit=`, and `?after=` the `next` of another page or an id.
Response list_bakes(Service& service, const Request& request) {
    const Page page = page_of(request);
    Bakes::Part part = service.bakes.list_after(page.after, page.limit);
    const Json next = part.next.empty() ? Json() : Json(part.next);
    return json_response({{"bakes", std::move(part.bakes)}, {"next", next}});
}

/// The bake after each change, and its end.
Response events(Service& service, const Request& request) {
    const std::string id = request.captures[0];
    (void)service.bakes.get(id);  // throws if there is none
    Response response{.content_type = "text/event-stream",
                      .headers = {{"Cache-Control", "no-store"}}};
    response.events = [&service, id, last = std::string()](std::string& out) mutable {
        const bool is_over = service.bakes.is_over(id);
        try {
            Json bake = service.bakes.get(id);
            bake.erase("request");
            const std::string now = dump(bake);
            if (now != last) out += "event: progress\ndata: " + now + "\n\n";
            last = now;
            if (is_over) out += "event: end\ndata: " + now + "\n\n";
        } catch (const Problem&) {
            out += "event: end\ndata: {\"state\":\"deleted\"}\n\n";
            return false;
        }
        return !is_over;
    };
    return response;
}

/// Follows all unfinished bakes and those that are ordered later.
class BakeWatch {
  public:
    explicit BakeWatch(const Bakes& bakes) : bakes_(&bakes) {}

    /// Appends an event for each bake that has changed since the last call.
    void append_events(std::string& out) {
        std::map<std::string, std::string> now;
        for (const Json& bake : bakes_->unfinished_and_newer(number_)) {
            const auto id = bake["id"].get<std::string>();
            std::string text = dump(bake);
            const auto last = last_.find(id);
            const bool is_new = last == last_.end() || last->second != text;
            if (is_new) out += "event: progress\ndata: " + text + "\n\n";
            now[id] = std::move(text);
        }
        for (const auto& [id, text] : last_) {
            if (!now.contains(id)) append_end(id, out);
        }
        last_ = std::move(now);
    }

  private:
    void append_end(const std::string& id, std::string& out) const {
        Json bake{{"id", id}, {"state", "deleted"}};
        try {
            bake = bakes_->get(id);
            bake.erase("request");
        } catch (const Problem&) {
            // It was deleted.
        }
        out += "event: end\ndata: " + dump(bake) + "\n\n";
    }

    const Bakes* bakes_;
    int64_t number_ = std::numeric_limits<int64_t>::max();  ///< bakes that have ended do not count
    std::map<std::string, std::string> last_;               ///< descriptions by id
};

/// One stream for all bakes: browsers open six connections to a server at most.
Response all_events(const Service& service) {
    Response response{.content_type = "text/event-stream",
                      .headers = {{"Cache-Control", "no-store"}}};
    response.events = [watch = BakeWatch(service.bakes)](std::string& out) mutable {
        watch.append_events(out);
        return true;
    };
    return response;
}

}  // namespace

std::vector<Route> bake_routes(Service& service) {
    constexpr auto kStorage = Plan::RunOn::Storage;
    const auto orders = [&](const char* pattern, Kind kind) {
        return Route{.method = "POST",
                     .pattern = pattern,
                     .access = Access::Writes,
                     .handle = [&, kind](Request& r) { return submit(service, kind, r); },
                     .body_limit = service.settings.max_body_bytes,
                     .run_on = kStorage};
    };
    return {
        orders("/v1/bakes", Kind::Volumes),
        orders("/v1/lightmap-bakes", Kind::Lightmaps),
        orders("/v1/reflection-bakes", Kind::Reflections),
        {.method = "GET",
         .pattern = "/v1/bakes",
         .handle = [&](Request& r) { return list_bakes(service, r); },
         .parameters = {"after", "limit"}},
        {.method = "GET",
         .pattern = "/v1/bakes/events",
         .handle = [&](Request&) { return all_events(service); }},
        {.method = "GET",
         .pattern = "/v1/bakes/{bake}",
         .handle = [&](Request& r) { return json_response(service.bakes.get(r.captures[0])); }},
        {.method = "GET",
         .pattern = "/v1/bakes/{bake}/events",
         .handle = [&](Request& r) { return events(service, r); }},
        {.method = "POST",
         .pattern = "/v1/bakes/{bake}/cancel",
         .access = Access::Writes,
         .handle = [&](Request& r) { return json_response(service.bakes.cancel(r.captures[0])); },
         .run_on = kStorage},
        {.method = "DELETE",
         .pattern = "/v1/bakes/{bake}",
         .access = Access::Writes,
         .handle =
             [&](Request& r) {
                 service.bakes.remove(r.captures[0]);
                 return Response{.status = 204, .content_type = ""};
             },
         .run_on = kStorage}};
}

}  // namespace tetralight::server
