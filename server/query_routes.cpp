// SPDX-License-Identifier: Apache-2.0
#include <charconv>
#include <cmath>
#include <cstring>
#include <glm/vec3.hpp>

#include <tetralight/base/str_cat.h>
#include <tetralight/probes/interpolate.h>
#include <tetralight/server/order.h>
#include <tetralight/server/problem.h>
#include <tetralight/server/query_binary.h>
#include <tetralight/server/service.h>

namespace tetralight::server {
namespace {

constexpr const char* kBinary = "application/octet-stream";
constexpr uint64_t kMostJson = uint64_t{8} << 20;
constexpr uint8_t kShHalf = 3;

/// The positions and settings of a query.
struct Query {
    std::span<const glm::vec3> positions;
    OutsideHull outside = {};
    bool is_half_precision = false;
};

constexpr const char* kFadeRange = "0 or in the range from 1e-06 to 1e+09";

/// 0 = the default.
bool is_fade(float metres) {
    return metres == 0.0f || (metres >= 1e-6f && metres <= 1e9f);
}

void check_positions(const Service& service, std::span<const glm::vec3> positions) {
    if (positions.size() > service.settings.max_positions) {
        throw Problem{413, "too_large",
                      str_cat("a query may have ", service.settings.max_positions, " positions"),
                      "positions", std::to_string(positions.size())};
    }
    for (size_t i = 0; i < positions.size(); ++i) {
        const glm::vec3& p = positions[i];
        if (std::isfinite(p.x + p.y + p.z) ||
            (std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z))) {
            continue;
        }
        throw Problem{400, "not_finite", str_cat("position ", i, " is not finite"),
                      str_cat("positions[", i, "]"), str_cat(p.x, ", ", p.y, ", ", p.z)};
    }
}

ProbeVolumeView view_for(const ProbeFile& file, const Query& query) {
    const ProbeVolumeView& view = file.view();
    if (!query.is_half_precision) return view.without_compact();
    if (!view.compact.empty()) return view;
    throw Problem{422, "bad_data", "the volume holds no half-precision probes", "precision",
                  "half"};
}

// JSON

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
    query.is_half_precision = values.text("precision") == "half";
    return query;
}

Query read_query(const Json& json, std::vector<glm::vec3>& positions) {
    const Json* list = Fields(json).find("positions");
    if (list == nullptr)
        throw Problem{400, "missing_value", "positions: is not given", "positions"};
    if (!list->is_array()) refuse("positions", *list, "an array");
    for (const Json& value : *list) positions.push_back(to_position(value, positions.size()));
    return read_settings(json, {.positions = positions});
}

/// Appends the shortest digits that give the same number when read.
void append_number(std::string& out, auto number) {
    char digits[32];
    out.append(digits, std::to_chars(digits, digits + sizeof digits, number).ptr);
}

template <class Vector>
void append_vector(std::string& out, const Vector& vector) {
    for (int i = 0; i < Vector::length(); ++i) {
        out += i == 0 ? '[' : ',';
        append_number(out, static_cast<double>(vector[i]));
    }
    out += ']';
}

/// Appends an answer as `tetralight query --json` writes it.
void append_answer(std::string& out, const ProbeVolumeView& volume, const glm::vec3& position,
                   const CellLocation& location) {
    const InterpolatedProbe answer = interpolate(volume, location);
    out += R"({"position":)";
    append_vector(out, position);
    out += R"(,"cell":)";
    const bool has_cell = location.cell < volume.cells.size();
    has_cell ? append_number(out, location.cell) : void(out += "null");
    out += R"(,"probes":[)";
    bool is_first = true;
    for (int i = 0; i < 4 && has_cell; ++i) {
        const uint32_t probe = volume.cells[location.cell].vertices[static_cast<size_t>(i)];
        if (probe == kNoIndex) continue;
        out += is_first ? R"({"probe":)" : R"(,{"probe":)";
        append_number(out, probe);
        out += R"(,"weight":)";
        append_number(out, static_cast<double>(location.weights[i]));
        out += '}';
        is_first = false;
    }
    out += R"(],"ambient":)";
    append_number(out, static_cast<double>(location.ambient));
    out += R"(,"irradiance_sh":)";
    is_first = true;
    for (const glm::vec3& coefficient : answer.irradiance.coefficients) {
        out += is_first ? '[' : ',';
        append_vector(out, coefficient);
        is_first = false;
    }
    out += R"(],"occlusion":)";
    append_vector(out, answer.occlusion);
    out += '}';
}

Response answer_json(Service& service, const ProbeFile& file, const Request& request) {
    if (request.body.size() > kMostJson) {
        throw Problem{
            413, "too_large",
            str_cat("a query in JSON may have ", kMostJson, " bytes; the binary form takes more"),
            "body", str_cat(request.body.size(), " bytes")};
    }
    const Json json = parse_object(request.body);
    std::vector<glm::vec3> positions;
    const Query query = read_query(json, positions);
    check_positions(service, positions);
    const ProbeVolumeView volume = view_for(file, query);
    std::string out = R"({"answers":[)";
    uint32_t hint = kNoIndex;
    for (const glm::vec3& position : positions) {
        if (request.is_abandoned) throw Problem{499, "abandoned", "the client has disconnected"};
        const CellLocation location = locate(volume, position, hint, query.outside);
        hint = location.cell;
        if (out.back() != '[') out += ',';
        append_answer(out, volume, position, location);
    }
    service.metrics.positions += positions.size();
    return {.body = out + "]}\n"};
}

// binary

QueryHeader read_header(const Request& request) {
    QueryHeader header;
    if (request.body.size() < sizeof header) {
        throw Problem{400, "invalid_header",
                      str_cat("the body is shorter than the header's ", sizeof header, " bytes"),
                      "body", str_cat(request.body.size(), " bytes")};
    }
    std::memcpy(&header, request.body.data(), sizeof header);
    const auto check = [](bool is_right, const char* field, auto value) {
        if (is_right) return;
        throw Problem{400, "invalid_header", str_cat(field, " is not one of its values"), field,
                      str_cat(value)};
    };
    check(header.magic == QueryHeader::kRequest, "magic", header.magic);
    const uint64_t expected = sizeof header + uint64_t{header.count} * sizeof(glm::vec3);
    if (request.body.size() != expected) {
        throw Problem{400, "invalid_header",
                      str_cat("the body has ", request.body.size(), " bytes where ", expected,
                              " are expected for this count"),
                      "count", str_cat(header.count)};
    }
    check(header.sh <= kShHalf, "sh", header.sh);
    check(header.wants <= (QueryHeader::kOcclusion | QueryHeader::kCells), "wants", header.wants);
    check(header.sh != 0 || header.wants != 0, "wants", header.wants);
    check(header.outside <= static_cast<uint8_t>(OutsidePolicy::Ambient), "outside",
          header.outside);
    check(header.precision <= 1, "precision", header.precision);
    if (!is_fade(header.fade_distance)) {
        throw Problem{400, "invalid_header", str_cat("fade is not ", kFadeRange), "fade",
                      str_cat(header.fade_distance)};
    }
    return header;
}

/// Offsets of the parts of an answer.
struct AnswerLayout {
    size_t sh = 0;
    size_t occlusion = 0;
    size_t cells = 0;
    size_t end = 0;
    ShFormat format = ShFormat::Coefficients;

    explicit AnswerLayout(const QueryHeader& header) {
        if (header.sh == 2) format = ShFormat::Packed;
        if (header.sh == kShHalf) format = ShFormat::Half;
        const size_t sh_size = header.sh == 0 ? 0 : value_count(format) * value_size(format);
        sh = sizeof header;
        // Halves take 54 bytes each; the next part is aligned to 4.
        occlusion = (sh + header.count * sh_size + 3) / 4 * 4;
        const bool has_occlusion = (header.wants & QueryHeader::kOcclusion) != 0;
        cells = occlusion + (has_occlusion ? header.count * sizeof(glm::vec4) : 0);
        const bool has_cells = (header.wants & QueryHeader::kCells) != 0;
        end = cells + (has_cells ? header.count * sizeof(CellLocation) : 0);
    }
};

ShOutput sh_output(const QueryHeader& header, const AnswerLayout& layout,
                   std::span<std::byte> bytes) {
    if (header.sh == 0) return {};
    return strided(bytes.subspan(layout.sh, layout.occlusion - layout.sh), layout.format,
                   value_count(layout.format) * value_size(layout.format));
}

OcclusionOutput occlusion_output(const QueryHeader& header, const AnswerLayout& layout,
                                 std::span<std::byte> bytes) {
    if ((header.wants & QueryHeader::kOcclusion) == 0) return {};
    return strided_occlusion(bytes.subspan(layout.occlusion, layout.cells - layout.occlusion),
                             sizeof(glm::vec4));
}

void require(const Status& status) {
    if (!status) throw Problem{500, "query", detail_of(status.error())};
}

Response answer_binary(Service& service, const ProbeFile& file, const Request& request) {
    QueryHeader header = read_header(request);
    const std::span positions(
        reinterpret_cast<const glm::vec3*>(request.body.data() + sizeof header), header.count);
    check_positions(service, positions);
    Query query{.positions = positions, .is_half_precision = header.precision == 1};
    query.outside.policy = static_cast<OutsidePolicy>(header.outside);
    if (header.fade_distance > 0.0f) query.outside.fade_distance = header.fade_distance;
    const ProbeVolumeView volume = view_for(file, query);

    const AnswerLayout layout(header);
    // Every byte is written below; a vector would first fill them with zeros.
    const std::shared_ptr<std::byte[]> memory(new std::byte[layout.end]);
    const std::span bytes(memory.get(), layout.end);
    header.magic = QueryHeader::kAnswer;
    std::memcpy(bytes.data(), &header, sizeof header);
    std::memset(bytes.data() + layout.occlusion - 3, 0, 3);
    const ShOutput irradiance = sh_output(header, layout, bytes);
    const OcclusionOutput occlusion = occlusion_output(header, layout, bytes);
    if ((header.wants & QueryHeader::kCells) == 0) {
        const auto report = interpolate(volume, {.positions = positions,
                                                 .irradiance = irradiance,
                                                 .occlusion = occlusion,
                                                 .outside = query.outside});
        require(report ? Status(Ok{}) : Status(report.error()));
    } else {
        const std::span locations(reinterpret_cast<CellLocation*>(bytes.data() + layout.cells),
                                  header.count);
        uint32_t hint = kNoIndex;
        for (size_t i = 0; i < positions.size(); ++i) {
            locations[i] = locate(volume, positions[i], hint, query.outside);
            hint = locations[i].cell;
        }
        const bool has_blend = header.sh != 0 || (header.wants & QueryHeader::kOcclusion) != 0;
        if (has_blend) require(blend(volume, locations, irradiance, occlusion));
    }
    service.metrics.positions += header.count;
    return {.content_type = kBinary, .body = Body(bytes, memory)};
}

Response query(Service& service, Request& request) {
    const auto volume = service.volumes.open(request.captures[0]);
    Response response = request.has_type(kBinary) ? answer_binary(service, volume->file, request)
                                                  : answer_json(service, volume->file, request);
    volume->require_whole();
    return response;
}

}  // namespace

std::vector<Route> query_routes(Service& service) {
    return {{.method = "POST",
             .pattern = "/v1/volumes/{volume}/query",
             .handle = [&](Request& request) { return query(service, request); },
             .body_limit = service.settings.max_body_bytes}};
}

}  // namespace tetralight::server
