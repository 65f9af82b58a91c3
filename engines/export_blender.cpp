// SPDX-License-Identifier: Apache-2.0
// A Python script that makes a mesh in Blender: none of the importers of Blender 3.4 keeps
// attributes of vertices. Its data are little-endian numbers in base64 (RFC 4648).
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <numbers>
#include <string_view>

#include <tetralight/base/str_cat.h>
#include <tetralight/engines/detail/probe_light.h>
#include <tetralight/engines/detail/targets.h>
#include <tetralight/engines/escape.h>

namespace tetralight::detail {
namespace {

constexpr std::string_view kHeader =
    R"(# Light probes as a mesh of vertices with attributes, for Blender 3.4 and later.
# Run it in the text editor of Blender, or by: blender --python FILE
import base64
import json
import sys
from array import array

import bpy

)";

constexpr std::string_view kBody = R"(

def numbers(code, text):
    values = array(code)
    values.frombytes(base64.b64decode(text))
    if sys.byteorder == "big":
        values.byteswap()
    return values


mesh = bpy.data.meshes.new(NAME)
positions = numbers("f", POSITIONS)
mesh.vertices.add(len(positions) // 3)
mesh.vertices.foreach_set("co", positions)
for name, kind, member, code, text in ATTRIBUTES:
    mesh.attributes.new(name, kind, "POINT").data.foreach_set(member, numbers(code, text))
mesh.attributes.active_color = mesh.attributes["mean_irradiance"]
mesh.update()
probes = bpy.data.objects.new(NAME, mesh)
probes.location = LOCATION
probes["probe_groups"] = json.dumps(GROUPS)
bpy.context.scene.collection.objects.link(probes)
)";

/// Columns are where Blender has glTF's axes: Y up becomes Z up, and Z becomes −Y.
const glm::mat3 kBlenderFromWorld({1, 0, 0}, {0, 0, 1}, {0, -1, 0});

/// In lines, which Python's decoder joins.
std::string base64(std::string_view bytes) {
    constexpr std::string_view kDigits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    constexpr size_t kBytesOfLine = 72;
    std::string text;
    for (size_t at = 0; at < bytes.size(); at += 3) {
        const size_t count = std::min<size_t>(3, bytes.size() - at);
        uint32_t bits = 0;
        for (size_t i = 0; i < 3; ++i) {
            bits = bits << 8 | (i < count ? static_cast<uint8_t>(bytes[at + i]) : 0u);
        }
        if (at % kBytesOfLine == 0) text += '\n';
        for (size_t i = 0; i < 4; ++i) text += i > count ? '=' : kDigits[bits >> (18 - 6 * i) & 63];
    }
    return text;
}

/// A string of Python that holds numbers.
template <class Number>
std::string data_of(const std::vector<Number>& values) {
    std::string bytes;
    for (const Number value : values) {
        const auto bits = std::bit_cast<uint32_t>(value);
        for (int byte = 0; byte < 4; ++byte) bytes += static_cast<char>(bits >> (8 * byte) & 255);
    }
    return str_cat("\"\"\"", base64(bytes), "\"\"\"");
}

/// The rows of the script's list of attributes.
class Attributes {
  public:
    /// One number each.
    void floats(std::string_view name, const std::vector<float>& values) {
        add(name, "FLOAT", "value", 'f', values);
    }

    void integers(std::string_view name, const std::vector<int32_t>& values) {
        add(name, "INT", "value", 'i', values);
    }

    /// Four numbers each.
    void colors(std::string_view name, const std::vector<float>& values) {
        add(name, "FLOAT_COLOR", "color", 'f', values);
    }

    /// Three numbers each.
    void vectors(std::string_view name, const std::vector<float>& values) {
        add(name, "FLOAT_VECTOR", "vector", 'f', values);
    }

    [[nodiscard]] const std::string& rows() const { return rows_; }

  private:
    template <class Number>
    void add(std::string_view name, std::string_view type, std::string_view member, char code,
             const std::vector<Number>& values) {
        rows_ += str_cat("    (\"", name, "\", \"", type, "\", \"", member, "\", \"", code, "\", ",
                         data_of(values), "),\n");
    }

    std::string rows_;
};

void add_light(const ProbeVolumeView& volume, Attributes& attributes) {
    const float y0 = 0.5f * std::sqrt(std::numbers::inv_pi_v<float>);
    std::vector<float> mean;
    std::array<std::vector<float>, kShCoefficientCount> sh;
    for (const IrradianceSh& world_light : probe_light(volume)) {
        const IrradianceSh light = rotate(world_light, kBlenderFromWorld);
        const glm::vec3 e = y0 * light.coefficients[0];
        mean.insert(mean.end(), {e.r, e.g, e.b, 1.0f});
        for (size_t i = 0; i < sh.size(); ++i) {
            const glm::vec3& c = light.coefficients[i];
            sh[i].insert(sh[i].end(), {c.r, c.g, c.b});
        }
    }
    attributes.colors("mean_irradiance", mean);
    for (size_t i = 0; i < sh.size(); ++i) {
        attributes.vectors(str_cat("irradiance_sh_", i), sh[i]);
    }
}

void add_other(const ProbeVolumeView& volume, Attributes& attributes) {
    attributes.floats("validity",
                      volume.validity.empty()
                          ? std::vector(volume.positions.size(), 1.0f)
                          : std::vector(volume.validity.begin(), volume.validity.end()));
    std::vector<float> errors;
    for (const ProbeHealth& health : volume.health) errors.push_back(health.standard_error);
    if (!errors.empty()) attributes.floats("standard_error", errors);
    std::vector<float> occlusion;
    for (const glm::vec4& o : volume.occlusion) {
        occlusion.insert(occlusion.end(), {o.x, o.y, o.z, o.w});
    }
    if (!occlusion.empty()) attributes.colors("occlusion", occlusion);
    std::vector<int32_t> groups;
    for (const uint32_t group : probe_groups(volume)) groups.push_back(static_cast<int32_t>(group));
    attributes.integers("group", groups);
}

/// Strings of JSON are strings of Python, too.
std::string group_list(const ProbeVolumeView& volume) {
    std::string list;
    for (const std::string_view name : split_names(volume.group_names)) {
        list += str_cat(list.empty() ? "" : ", ", quoted_for_json(name));
    }
    return str_cat('[', list, ']');
}

}  // namespace

Result<ExportedVolume> export_blender(const ProbeVolumeView& volume,
                                      const ExportSettings& settings) {
    std::vector<float> positions;
    for (const glm::vec3& world : volume.positions) {
        const glm::vec3 p = kBlenderFromWorld * world;
        positions.insert(positions.end(), {p.x, p.y, p.z});
    }
    Attributes attributes;
    add_light(volume, attributes);
    add_other(volume, attributes);
    const glm::dvec3& origin = volume.info.world_origin;
    std::string text =
        str_cat(kHeader, "NAME = ", quoted_for_json(settings.name),
                "\nGROUPS = ", group_list(volume), "\nLOCATION = (", origin.x, ", ", 0.0 - origin.z,
                ", ", origin.y, ")\nPOSITIONS = ", data_of(positions), "\nATTRIBUTES = [\n",
                attributes.rows(), "]\n", kBody);
    return ExportedVolume{{{settings.name + ".py", std::move(text)}}, {}, {}};
}

}  // namespace tetralight::detail
