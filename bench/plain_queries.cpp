// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bench/plain_queries.h>

#include <cstring>
#include <nlohmann/json.hpp>
#include <vector>

#include <tetralight/bench/harness.h>
#include <tetralight/probes/interpolate.h>
#include <tetralight/server/query_binary.h>

namespace tetralight::bench {
namespace {

using Json = nlohmann::ordered_json;
using server::QueryHeader;

template <class Value>
std::span<Value> take(std::span<std::byte>& bytes, size_t count) {
    const std::span<Value> values(reinterpret_cast<Value*>(bytes.data()), count);
    bytes = bytes.subspan(values.size_bytes());
    return values;
}

PlainAnswer answer_binary(const ProbeVolumeView& volume, const std::string& body) {
    QueryHeader header;
    std::memcpy(&header, body.data(), sizeof header);
    const size_t count = header.count;
    const size_t sh_count = header.sh == 0 ? 0 : count;
    const size_t occlusion_count = (header.wants & QueryHeader::kOcclusion) == 0 ? 0 : count;
    const size_t cell_count = (header.wants & QueryHeader::kCells) == 0 ? 0 : count;
    const size_t size = sizeof header + sh_count * sizeof(IrradianceSh) +
                        occlusion_count * sizeof(glm::vec4) + cell_count * sizeof(CellLocation);
    const std::shared_ptr<char[]> memory(new char[size]);
    std::span rest = std::as_writable_bytes(std::span(memory.get(), size));
    header.magic = QueryHeader::kAnswer;
    std::memcpy(rest.data(), &header, sizeof header);
    rest = rest.subspan(sizeof header);
    InterpolationBatch batch;
    batch.positions = {reinterpret_cast<const glm::vec3*>(body.data() + sizeof header), count};
    batch.irradiance = take<IrradianceSh>(rest, sh_count);
    batch.occlusion = take<glm::vec4>(rest, occlusion_count);
    batch.locations = take<CellLocation>(rest, cell_count);
    require(bool(interpolate(volume, batch)), "batch");
    return {memory, size};
}

template <class Vector>
Json to_json(const Vector& vector) {
    Json json = Json::array();
    for (int i = 0; i < Vector::length(); ++i) json.push_back(vector[i]);
    return json;
}

Json to_json(const Cell& cell, const CellLocation& location) {
    Json probes = Json::array();
    for (int i = 0; i < 4; ++i) {
        const uint32_t probe = cell.vertices[static_cast<size_t>(i)];
        if (probe == kNoIndex) continue;
        probes.push_back({{"probe", probe}, {"weight", location.weights[i]}});
    }
    return probes;
}

PlainAnswer answer_json(const ProbeVolumeView& volume, const std::string& body) {
    const Json query = Json::parse(body);
    std::vector<glm::vec3> positions;
    for (const Json& p : query.at("positions")) {
        positions.emplace_back(p[0].get<float>(), p[1].get<float>(), p[2].get<float>());
    }
    std::vector<IrradianceSh> irradiance(positions.size());
    std::vector<glm::vec4> occlusion(positions.size());
    std::vector<CellLocation> locations(positions.size());
    require(bool(interpolate(volume, {.positions = positions,
                                      .irradiance = irradiance,
                                      .occlusion = occlusion,
                                      .locations = locations})),
            "batch");
    Json answers = Json::array();
    for (size_t i = 0; i < positions.size(); ++i) {
        Json coefficients = Json::array();
        for (const glm::vec3& c : irradiance[i].coefficients) coefficients.push_back(to_json(c));
        answers.push_back({{"position", to_json(positions[i])},
                           {"cell", locations[i].cell},
                           {"probes", to_json(volume.cells[locations[i].cell], locations[i])},
                           {"ambient", locations[i].ambient},
                           {"irradiance_sh", std::move(coefficients)},
                           {"occlusion", to_json(occlusion[i])}});
    }
    const auto text = std::make_shared<std::string>(Json{{"answers", std::move(answers)}}.dump());
    return {std::shared_ptr<const char[]>(text, text->data()), text->size()};
}

}  // namespace

PlainHandler answers_binary(const ProbeVolumeView& volume) {
    return [volume](const std::string& body) { return answer_binary(volume, body); };
}

PlainHandler answers_json(const ProbeVolumeView& volume) {
    return [volume](const std::string& body) { return answer_json(volume, body); };
}

}  // namespace tetralight::bench
