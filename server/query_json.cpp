// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <functional>
#include <utility>
#include <vector>

#include <tetralight/base/str_cat.h>
#include <tetralight/probes/answer_json.h>
#include <tetralight/server/json.h>
#include <tetralight/server/order.h>
#include <tetralight/server/problem.h>
#include <tetralight/server/query.h>

namespace tetralight::server {
namespace {

constexpr uint64_t kMostJson = uint64_t{8} << 20;

glm::vec3 to_position(const Json& value, size_t index) {
    const bool is_triple = value.is_array() && value.size() == 3 && value[0].is_number() &&
                           value[1].is_number() && value[2].is_number();
    if (!is_triple) refuse(str_cat("positions[", index, "]"), value, "three numbers");
    return {value[0].get<float>(), value[1].get<float>(), value[2].get<float>()};
}

/// Reads all members but the positions. The volume is in the path, and a fade of 0 is the default.
Query read_settings(const Json& json, Query query) {
    if (json.size() == 1) return query;
    if (json.contains("volume")) {
        throw Problem{400, "unknown_member", "\"volume\" is in the path of a query", "volume",
                      shown(json["volume"])};
    }
    Json order = json;
    order["volume"] = "in the path";
    if (order.value("fade", Json()) == 0) order.erase("fade");
    const auto values = check_order(settings::kQuery, order, "positions");
    const std::string outside = values.text("outside");
    if (outside == "clamp") query.outside.policy = OutsidePolicy::Clamp;
    if (outside == "ambient") query.outside.policy = OutsidePolicy::Ambient;
    if (values.is_given("fade")) query.outside.fade_distance = values.number32("fade");
    if (values.text("walls") == "ignore") query.walls = Walls::Ignore;
    query.is_half_precision = values.text("precision") == "half";
    return query;
}

/// Takes the numbers out of the list of positions while a query is parsed, so that no JSON value
/// is kept for each of them. The list is empty afterwards.
class PositionTaker {
  public:
    explicit PositionTaker(std::vector<glm::vec3>& positions) : positions_(positions) {}

    /// A callback of the parser. Returns false for values that are not kept.
    bool operator()(int depth, Json::parse_event_t event, const Json& value) {
        using Event = Json::parse_event_t;
        constexpr int kMember = 1, kPosition = 2, kCoordinate = 3;
        if (event == Event::key && depth == kMember) is_in_list_ = value == "positions";
        if (!is_in_list_ || depth < kPosition) return true;
        if (event == Event::value && depth == kCoordinate && value.is_number() && count_ < 3) {
            positions_.back()[count_++] = value.get<float>();
            return false;
        }
        if (event == Event::array_start && depth == kPosition) {
            positions_.emplace_back();
            count_ = 0;
            return true;
        }
        const bool is_position = event == Event::array_end && depth == kPosition && count_ == 3;
        has_only_positions_ = has_only_positions_ && is_position;
        return !is_position;
    }

    /// False if something else than positions was in the list.
    [[nodiscard]] bool has_only_positions() const { return has_only_positions_; }

  private:
    std::vector<glm::vec3>& positions_;
    bool is_in_list_ = false;
    bool has_only_positions_ = true;
    int count_ = 0;
};

/// Reads positions from a document that holds them. Its errors say which one is wrong.
void read_positions(const Json& json, std::vector<glm::vec3>& positions) {
    positions.clear();
    const Json* list = Fields(json).find("positions");
    if (list == nullptr)
        throw Problem{400, "missing_value", "positions: is not given", "positions"};
    if (!list->is_array()) refuse("positions", *list, "an array");
    for (const Json& value : *list) positions.push_back(to_position(value, positions.size()));
}

Query read_query(const std::string& body, std::vector<glm::vec3>& positions) {
    if (body.size() > kMostJson) {
        throw Problem{
            413, "too_large",
            str_cat("a query in JSON may have ", kMostJson, " bytes; the binary form takes more"),
            "body", str_cat(body.size(), " bytes")};
    }
    PositionTaker taker(positions);
    Json json = parse_object(body, std::ref(taker));
    const auto list = json.find("positions");
    if (!taker.has_only_positions() || list == json.end() || !list->is_array()) {
        json = parse_object(body);
        read_positions(json, positions);
    }
    return read_settings(json, {.positions = positions});
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
        require(interpolate(volume_, {.positions = positions,
                                      .irradiance = irradiance_,
                                      .occlusion = occlusion_,
                                      .outside = query_.outside,
                                      .locations = locations_,
                                      .walls = query_.walls}));
        hide_probes(volume_, std::span(locations_).first(count), {query_.walls});
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
};

}  // namespace

Response answer_json(Service& service, const ProbeFile& file, const Request& request) {
    std::vector<glm::vec3> positions;
    const Query query = read_query(request.body, positions);
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
