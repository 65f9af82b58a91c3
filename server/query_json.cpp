// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <utility>
#include <vector>

#include <tetralight/base/str_cat.h>
#include <tetralight/probes/answer_json.h>
#include <tetralight/probes/uniform_receiver.h>
#include <tetralight/server/json.h>
#include <tetralight/server/order.h>
#include <tetralight/server/problem.h>
#include <tetralight/server/query.h>

namespace tetralight::server {
namespace {

constexpr uint64_t kMostJson = uint64_t{8} << 20;

/// The lists of a query.
struct QueryLists {
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;

    /// Null if the member is no list of triples.
    [[nodiscard]] std::vector<glm::vec3>* find(const Json& member) {
        if (member == "positions") return &positions;
        return member == "normals" ? &normals : nullptr;
    }
};

glm::vec3 to_triple(const Json& value, const char* member, size_t index) {
    const bool is_triple = value.is_array() && value.size() == 3 && value[0].is_number() &&
                           value[1].is_number() && value[2].is_number();
    if (!is_triple) refuse(str_cat(member, "[", index, "]"), value, "three numbers");
    return {value[0].get<float>(), value[1].get<float>(), value[2].get<float>()};
}

/// Gives normals the length 1. Throws a `Problem` if they are not one for each position.
void normalize(QueryLists& lists) {
    std::vector<glm::vec3>& normals = lists.normals;
    if (normals.size() != lists.positions.size()) {
        throw Problem{
            400, "invalid_value",
            str_cat("normals: ", normals.size(), " for ", lists.positions.size(), " positions"),
            "normals", str_cat(normals.size())};
    }
    for (size_t i = 0; i < normals.size(); ++i) {
        const glm::dvec3 normal(normals[i]);
        const double length = glm::length(normal);
        if (!(length > 0.0 && std::isfinite(length))) {
            throw Problem{400, "invalid_value", str_cat("normal ", i, " is zero or not finite"),
                          str_cat("normals[", i, "]"),
                          str_cat(normal.x, ", ", normal.y, ", ", normal.z)};
        }
        normals[i] = glm::vec3(normal / length);
    }
}

bool has_normals(const Json& json) {
    const auto found = json.find("normals");
    return found != json.end() && !found->is_null();
}

void read_receiver(const settings::Values& values, const Json& json, Query& query) {
    if (values.text("walls") == "ignore") query.receiver.walls = Walls::Ignore;
    query.receiver.rendering_layers = values.bits("rendering_layers", kAllRenderingLayers);
    query.receiver.radius = values.number32("radius");
    query.normal_offset = values.number32("normal_offset");
    if (values.is_given("normal_offset") && !has_normals(json)) {
        throw setting_problem(values.error("normal_offset", "needs normals"), json);
    }
}

/// Reads all members but the lists. The volume is in the path, and a fade of 0 is the default.
Query read_settings(const Json& json, Query query) {
    if (json.size() == 1) return query;
    if (json.contains("volume")) {
        throw Problem{400, "unknown_member", "\"volume\" is in the path of a query", "volume",
                      shown(json["volume"])};
    }
    Json order = json;
    order["volume"] = "in the path";
    if (order.value("fade", Json()) == 0) order.erase("fade");
    const auto values = check_order(settings::kQuery, order, "positions normals");
    const std::string outside = values.text("outside");
    if (outside == "clamp") query.outside.policy = OutsidePolicy::Clamp;
    if (outside == "ambient") query.outside.policy = OutsidePolicy::Ambient;
    if (values.is_given("fade")) query.outside.fade_distance = values.number32("fade");
    read_receiver(values, json, query);
    query.is_half_precision = values.text("precision") == "half";
    return query;
}

/// Takes the numbers out of the lists of positions and normals while a query is parsed, so that no
/// JSON value is kept for each of them. The lists are empty in the document afterwards.
class ListTaker {
  public:
    explicit ListTaker(QueryLists& lists) : lists_(lists) {}

    /// A callback of the parser. Returns false for values that are not kept.
    bool operator()(int depth, Json::parse_event_t event, const Json& value) {
        using Event = Json::parse_event_t;
        constexpr int kMember = 1, kTriple = 2, kCoordinate = 3;
        if (event == Event::key && depth == kMember) list_ = lists_.find(value);
        if (list_ == nullptr || depth < kTriple) return true;
        if (event == Event::value && depth == kCoordinate && value.is_number() && count_ < 3) {
            list_->back()[count_++] = value.get<float>();
            return false;
        }
        if (event == Event::array_start && depth == kTriple) {
            list_->emplace_back();
            count_ = 0;
            return true;
        }
        const bool is_triple = event == Event::array_end && depth == kTriple && count_ == 3;
        has_only_triples_ = has_only_triples_ && is_triple;
        return !is_triple;
    }

    /// False if something else than triples was in a list.
    [[nodiscard]] bool has_only_triples() const { return has_only_triples_; }

  private:
    QueryLists& lists_;
    std::vector<glm::vec3>* list_ = nullptr;  ///< the open one
    bool has_only_triples_ = true;
    int count_ = 0;
};

void read_list(const Json& json, const char* member, std::vector<glm::vec3>& triples) {
    if (!json.is_array()) refuse(member, json, "an array");
    for (const Json& value : json) triples.push_back(to_triple(value, member, triples.size()));
}

/// Reads the lists of a document that holds them. Its errors say which element is wrong.
void read_lists(const Json& json, QueryLists& lists) {
    lists = {};
    const Json* positions = Fields(json).find("positions");
    if (positions == nullptr) {
        throw Problem{400, "missing_value", "positions: is not given", "positions"};
    }
    read_list(*positions, "positions", lists.positions);
    if (has_normals(json)) read_list(json["normals"], "normals", lists.normals);
}

bool is_list(const Json& json, const char* member) {
    const auto found = json.find(member);
    return found != json.end() && found->is_array();
}

Query read_query(const std::string& body, QueryLists& lists) {
    if (body.size() > kMostJson) {
        throw Problem{
            413, "too_large",
            str_cat("a query in JSON may have ", kMostJson, " bytes; the binary form takes more"),
            "body", str_cat(body.size(), " bytes")};
    }
    // With a callback the parser looks through all elements of an array when an object in it ends.
    constexpr ptrdiff_t kMostObjects = 64;
    Json json;
    bool has_taken_lists = false;
    if (std::ranges::count(body, '{') <= kMostObjects) {
        ListTaker taker(lists);
        json = parse_object(body, std::ref(taker));
        has_taken_lists = taker.has_only_triples() && is_list(json, "positions") &&
                          (!has_normals(json) || is_list(json, "normals"));
    }
    if (!has_taken_lists) {
        json = parse_object(body);
        read_lists(json, lists);
    }
    if (has_normals(json)) normalize(lists);
    return read_settings(json, {.positions = lists.positions, .normals = lists.normals});
}

/// Answers some positions at a time, so that all of it stays in the cache until it is text.
class JsonAnswers {
  public:
    static constexpr size_t kMost = 1024;

    JsonAnswers(const ProbeVolumeView& volume, const Query& query)
        : volume_(volume), query_(query), text_(R"({"answers":[)") {
        const size_t count = std::min(kMost, query.positions.size());
        irradiance_.resize(count);
        occlusion_.resize(count);
        locations_.resize(count);
    }

    /// Appends the answers of [begin, begin + count). Precondition: count ≤ kMost.
    void append(size_t begin, size_t count) {
        const auto positions = query_.positions.subspan(begin, count);
        InterpolationBatch batch{.positions = positions,
                                 .irradiance = irradiance_,
                                 .occlusion = occlusion_,
                                 .outside = query_.outside,
                                 .locations = locations_,
                                 .normal_offset = query_.normal_offset};
        if (!query_.normals.empty()) batch.normals = query_.normals.subspan(begin, count);
        receiver_.set(query_.receiver, batch);
        require(interpolate(volume_, batch));
        hide_probes(volume_, std::span(locations_).first(count), query_.receiver);
        char text[kAnswerJsonSize];
        for (size_t i = 0; i < count; ++i) {
            char* const end = write_json(
                text, volume_, {positions[i], locations_[i], irradiance_[i], occlusion_[i]});
            *end = ',';
            text_.append(text, end + 1);
        }
        // Answers are of about the same length.
        const size_t all = query_.positions.size();
        if (begin == 0 && all > count) text_.reserve(text_.size() / count * (all + all / 64));
    }

    [[nodiscard]] std::string take() {
        if (text_.back() == ',') text_.pop_back();
        text_ += "]}\n";
        return std::move(text_);
    }

  private:
    const ProbeVolumeView& volume_;
    const Query& query_;
    std::string text_;
    std::vector<IrradianceSh> irradiance_;
    std::vector<glm::vec4> occlusion_;
    std::vector<CellLocation> locations_;
    UniformReceiver receiver_;
};

}  // namespace

Response answer_json(Service& service, const ProbeFile& file, const Request& request) {
    QueryLists lists;
    const Query query = read_query(request.body, lists);
    const std::span<const glm::vec3> positions = query.positions;
    check_positions(service, positions);
    const ProbeVolumeView volume = view_for(file, query);
    JsonAnswers answers(volume, query);
    for (size_t begin = 0; begin < positions.size(); begin += JsonAnswers::kMost) {
        if (request.is_abandoned) throw Problem{499, "abandoned", "the client has disconnected"};
        answers.append(begin, std::min(JsonAnswers::kMost, positions.size() - begin));
    }
    service.metrics.positions += positions.size();
    return {.body = answers.take()};
}

}  // namespace tetralight::server
