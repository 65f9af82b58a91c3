// SPDX-License-Identifier: Apache-2.0
#include "tests/conformance/vector_json.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <limits>
#include <nlohmann/json.hpp>

namespace tetralight::conformance {
namespace {

using nlohmann::json;

constexpr std::array kPrecisions{"half", "full"};
constexpr std::array kPolicies{"extrapolate", "clamp", "ambient"};
constexpr std::array kWalls{"hide", "ignore"};

std::string number(float value) {
    if (std::isnan(value)) return "\"nan\"";
    if (std::isinf(value)) return value > 0.0f ? "\"inf\"" : "\"-inf\"";
    if (value == 0.0f) return "0";
    std::array<char, 32> text;
    return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr};
}

/// `[1,2,3]` of `count` values that `value(i)` writes.
template <class Value>
std::string array_of(size_t count, Value value) {
    std::string text = "[";
    for (size_t i = 0; i < count; ++i) text += (i == 0 ? "" : ",") + value(i);
    return text + "]";
}

template <class Vector>
std::string vector_text(const Vector& v, size_t count) {
    return array_of(count, [&](size_t i) { return number(v[static_cast<int>(i)]); });
}

std::string quoted(const std::string& text) {
    return '"' + text + '"';
}

std::string member(const std::string& name, const std::string& value) {
    return quoted(name) + ":" + value;
}

std::string options_text(const VectorOptions& options) {
    const VectorOptions standard;
    std::vector<std::string> members;
    const auto add = [&](bool is_set, const std::string& name, const std::string& value) {
        if (is_set) members.push_back(member(name, value));
    };
    const OutsideHull& outside = options.outside;
    const Receiver& receiver = options.receiver;
    const std::vector<float>& weights = options.layer_weights;
    add(options.precision != standard.precision, "precision",
        quoted(kPrecisions[static_cast<size_t>(options.precision)]));
    add(outside.policy != standard.outside.policy, "outside",
        quoted(kPolicies[static_cast<size_t>(outside.policy)]));
    add(outside.fade_distance != standard.outside.fade_distance, "fade_distance",
        number(outside.fade_distance));
    add(receiver.walls != standard.receiver.walls, "walls",
        quoted(kWalls[static_cast<size_t>(receiver.walls)]));
    add(receiver.rendering_layers != kAllRenderingLayers, "rendering_layers",
        std::to_string(receiver.rendering_layers));
    add(receiver.radius != 0.0f, "radius", number(receiver.radius));
    add(options.normal_offset.has_value(), "normal_offset",
        number(options.normal_offset.value_or(0.0f)));
    add(!weights.empty(), "layer_weights",
        array_of(weights.size(), [&](size_t i) { return number(weights[i]); }));
    std::string text;
    for (const std::string& m : members) text += (text.empty() ? "" : ",") + m;
    return "{" + text + "}";
}

std::string answer_text(const VectorAnswer& answer, bool has_normal,
                        const ProbeVolumeView& volume) {
    const CellLocation& location = answer.location;
    const auto probes = probes_of(volume, location);
    const auto& coefficients = answer.light.irradiance.coefficients;
    const auto light = [&](size_t i) { return vector_text(coefficients[i], 3); };
    const auto rgb = [&](size_t i) { return vector_text(answer.irradiance[i], 3); };
    const auto probe = [&](size_t i) { return std::to_string(probes[i]); };
    const bool has_cell = location.cell != kNoIndex;
    const std::string normal =
        has_normal ? "," + member("normal", vector_text(answer.at.normal, 3)) : "";
    return "{" + member("kind", quoted(answer.at.kind)) + "," +
           member("position", vector_text(answer.at.position, 3)) + normal + "," +
           member("cell", has_cell ? std::to_string(location.cell) : "null") + "," +
           member("probes", array_of(probes.size(), probe)) + "," +
           member("barycentric", vector_text(location.weights, probes.size())) + "," +
           member("weights", vector_text(answer.visible.weights, probes.size())) + "," +
           member("ambient", number(location.ambient)) + "," +
           member("irradiance_sh", array_of(coefficients.size(), light)) + "," +
           member("occlusion", vector_text(answer.light.occlusion, 4)) + "," +
           member("irradiance", array_of(answer.irradiance.size(), rgb)) + "}";
}

std::string case_text(const VectorCase& made, const ProbeVolumeView& volume) {
    std::string text = "{" + member("options", options_text(made.options)) + ",\"answers\":[\n";
    for (size_t i = 0; i < made.answers.size(); ++i) {
        const bool has_normal = made.options.normal_offset.has_value();
        text += (i == 0 ? "" : ",\n") + answer_text(made.answers[i], has_normal, volume);
    }
    return text + "\n]}";
}

float float_of(const json& value) {
    if (value.is_number()) return static_cast<float>(value.get<double>());
    if (value == "nan") return std::numeric_limits<float>::quiet_NaN();
    const float infinity = std::numeric_limits<float>::infinity();
    return value == "-inf" ? -infinity : infinity;
}

/// The first numbers of a vector.
template <class Vector>
void read_vector(const json& values, Vector& v) {
    for (size_t i = 0; i < values.size(); ++i) v[static_cast<int>(i)] = float_of(values[i]);
}

/// Sets an enumerator whose number is the place of its name.
template <class Enum, size_t kCount>
void read_name(const json& options, const char* key, const std::array<const char*, kCount>& names,
               Enum& to) {
    if (!options.contains(key)) return;
    for (size_t i = 0; i < kCount; ++i) {
        if (options[key] == names[i]) to = static_cast<Enum>(i);
    }
}

VectorOptions read_options(const json& from) {
    VectorOptions options;
    read_name(from, "precision", kPrecisions, options.precision);
    read_name(from, "outside", kPolicies, options.outside.policy);
    read_name(from, "walls", kWalls, options.receiver.walls);
    options.outside.fade_distance = float_of(from.value("fade_distance", json(10.0)));
    options.receiver.rendering_layers = from.value("rendering_layers", kAllRenderingLayers);
    options.receiver.radius = float_of(from.value("radius", json(0.0)));
    if (from.contains("normal_offset")) options.normal_offset = float_of(from["normal_offset"]);
    for (const json& weight : from.value("layer_weights", json::array())) {
        options.layer_weights.push_back(float_of(weight));
    }
    return options;
}

VectorAnswer read_answer(const json& from) {
    VectorAnswer answer;
    answer.at.kind = from["kind"];
    read_vector(from["position"], answer.at.position);
    if (from.contains("normal")) read_vector(from["normal"], answer.at.normal);
    answer.location.cell = from["cell"].is_null() ? kNoIndex : from["cell"].get<uint32_t>();
    answer.location.ambient = float_of(from["ambient"]);
    answer.visible = answer.location;
    read_vector(from["barycentric"], answer.location.weights);
    read_vector(from["weights"], answer.visible.weights);
    for (size_t i = 0; i < answer.light.irradiance.coefficients.size(); ++i) {
        read_vector(from["irradiance_sh"][i], answer.light.irradiance.coefficients[i]);
    }
    read_vector(from["occlusion"], answer.light.occlusion);
    for (const json& rgb : from["irradiance"]) {
        read_vector(rgb, answer.irradiance.emplace_back());
    }
    return answer;
}

}  // namespace

std::string write_vectors(const VectorText& vectors, const ProbeVolumeView& volume) {
    const auto normals = vector_normals();
    const auto normal = [&](size_t i) { return vector_text(normals[i], 3); };
    std::string text = "{" + member("volume", quoted(vectors.volume)) + ",\n" +
                       member("about", quoted(vectors.about)) + ",\n" +
                       member("largest_light", number(vectors.largest_light)) + ",\n" +
                       member("normals", array_of(normals.size(), normal)) + ",\n\"cases\":[\n";
    for (size_t i = 0; i < vectors.cases.size(); ++i) {
        text += (i == 0 ? "" : ",\n") + case_text(vectors.cases[i], volume);
    }
    return text + "\n]}\n";
}

VectorText read_vectors(std::string_view text) {
    const json from = json::parse(text);
    VectorText vectors{from["volume"], from["about"], float_of(from["largest_light"]), {}};
    for (const json& source : from["cases"]) {
        VectorCase& made = vectors.cases.emplace_back();
        made.options = read_options(source["options"]);
        for (const json& answer : source["answers"]) made.answers.push_back(read_answer(answer));
    }
    return vectors;
}

}  // namespace tetralight::conformance
