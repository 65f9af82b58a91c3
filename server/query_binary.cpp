// SPDX-License-Identifier: Apache-2.0
#include <tetralight/server/query_binary.h>

#include <cstring>
#include <memory>

#include <tetralight/base/str_cat.h>
#include <tetralight/server/problem.h>
#include <tetralight/server/query.h>

namespace tetralight::server {
namespace {

constexpr uint8_t kShHalf = 3;

constexpr const char* kFadeRange = "0 or in the range from 1e-06 to 1e+09";

/// 0 = the default.
bool is_fade(float metres) {
    return metres == 0.0f || (metres >= 1e-6f && metres <= 1e9f);
}

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
    constexpr uint8_t kAnswers = QueryHeader::kOcclusion | QueryHeader::kCells;
    check(header.wants <= (kAnswers | QueryHeader::kIgnoreWalls), "wants", header.wants);
    check(header.sh != 0 || (header.wants & kAnswers) != 0, "wants", header.wants);
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

std::span<CellLocation> location_output(const QueryHeader& header, const AnswerLayout& layout,
                                        std::span<std::byte> bytes) {
    if ((header.wants & QueryHeader::kCells) == 0) return {};
    return {reinterpret_cast<CellLocation*>(bytes.data() + layout.cells), header.count};
}

}  // namespace

Response answer_binary(Service& service, const ProbeFile& file, const Request& request) {
    QueryHeader header = read_header(request);
    const std::span positions(
        reinterpret_cast<const glm::vec3*>(request.body.data() + sizeof header), header.count);
    check_positions(service, positions);
    Query query{.positions = positions, .is_half_precision = header.precision == 1};
    query.outside.policy = static_cast<OutsidePolicy>(header.outside);
    if (header.fade_distance > 0.0f) query.outside.fade_distance = header.fade_distance;
    if ((header.wants & QueryHeader::kIgnoreWalls) != 0) query.receiver.walls = Walls::Ignore;
    const ProbeVolumeView volume = view_for(file, query);

    const AnswerLayout layout(header);
    // Every byte is written below; a vector would first fill them with zeros.
    const std::shared_ptr<std::byte[]> memory(new std::byte[layout.end]);
    const std::span bytes(memory.get(), layout.end);
    header.magic = QueryHeader::kAnswer;
    std::memcpy(bytes.data(), &header, sizeof header);
    std::memset(bytes.data() + layout.occlusion - 3, 0, 3);
    require(interpolate(volume, {.positions = positions,
                                 .irradiance = sh_output(header, layout, bytes),
                                 .occlusion = occlusion_output(header, layout, bytes),
                                 .outside = query.outside,
                                 .locations = location_output(header, layout, bytes),
                                 .walls = query.receiver.walls}));
    hide_probes(volume, location_output(header, layout, bytes), query.receiver);
    service.metrics.positions += header.count;
    return {.content_type = "application/octet-stream", .body = Body(bytes, memory)};
}

}  // namespace tetralight::server
