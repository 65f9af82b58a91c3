// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cmath>

#include <tetralight/base/str_cat.h>
#include <tetralight/engines/detail/probe_light.h>
#include <tetralight/engines/detail/targets.h>
#include <tetralight/engines/detail/xyz_text.h>
#include <tetralight/engines/escape.h>

namespace tetralight::detail {
namespace {

/// Writes an object member by member. Numbers have the shortest form that gives the same float,
/// which the JSON library would write as a double.
class JsonObject {
  public:
    void member(const char* name, const std::string& value) {
        text_ += str_cat(text_.empty() ? "{\n  \"" : ",\n  \"", name, "\": ", value);
    }

    /// An array of `count` elements, one on each line.
    template <class Element>
    void array(const char* name, size_t count, Element&& element) {
        std::string value = "[";
        for (size_t i = 0; i < count; ++i) {
            value += i == 0 ? "\n    " : ",\n    ";
            value += element(i);
        }
        member(name, value + (count == 0 ? "]" : "\n  ]"));
    }

    [[nodiscard]] std::string text() && { return std::move(text_) + "\n}\n"; }

  private:
    std::string text_;
};

template <class Numbers>
std::string numbers(const Numbers& values, size_t count) {
    std::string text = "[";
    for (size_t i = 0; i < count; ++i) text += str_cat(i == 0 ? "" : ", ", values[i]);
    return text + "]";
}

std::string coefficients(const IrradianceSh& light) {
    return numbers(&light.coefficients[0].x, 3 * kShCoefficientCount);
}

/// JSON has no infinity.
std::string number_or_null(float number) {
    return std::isfinite(number) ? str_cat(number) : "null";
}

const char* shape_of(Dimension dimension) {
    constexpr std::array kShapes{"none", "points", "segments", "triangles", "tetrahedra"};
    return kShapes[static_cast<size_t>(dimension)];
}

}  // namespace

Result<ExportedVolume> export_json(const ProbeVolumeView& volume, const ExportSettings& settings) {
    const auto light = probe_light(volume);
    const auto groups = probe_groups(volume);
    const auto names = split_names(volume.group_names);
    const auto corners = static_cast<size_t>(cell_vertex_count(volume.info.dimension));
    JsonObject json;
    json.member("format", "\"tetralight probes\"");
    json.member("version", "1");
    json.member("unit", "\"metres, right-handed, Y up; irradiance, not divided by pi\"");
    json.member("ambient", coefficients(volume.info.ambient));
    json.array("groups", names.size(), [&](size_t i) { return quoted_for_json(names[i]); });
    json.array("positions", volume.positions.size(), [&](size_t i) {
        return str_cat('[', xyz_text(world_position(volume, static_cast<uint32_t>(i))), ']');
    });
    json.array("irradiance_sh", light.size(), [&](size_t i) { return coefficients(light[i]); });
    json.array("occlusion", volume.occlusion.size(),
               [&](size_t i) { return numbers(&volume.occlusion[i].x, 4); });
    json.array("validity", volume.validity.size(),
               [&](size_t i) { return str_cat(volume.validity[i]); });
    json.array("standard_error", volume.health.size(),
               [&](size_t i) { return str_cat(volume.health[i].standard_error); });
    json.array("surface_distance", volume.health.size(),
               [&](size_t i) { return number_or_null(volume.health[i].surface_distance); });
    json.array("group", groups.size(), [&](size_t i) {
        return groups[i] == kNoIndex ? std::string("null") : str_cat(groups[i]);
    });
    json.member("cell_shape", str_cat('"', shape_of(volume.info.dimension), '"'));
    json.array("cells", volume.info.inner_cell_count,
               [&](size_t i) { return numbers(volume.cells[i].vertices, corners); });
    json.array("hull", volume.cells.size() - volume.info.inner_cell_count, [&](size_t i) {
        return numbers(volume.cells[volume.info.inner_cell_count + i].vertices, corners - 1);
    });
    return ExportedVolume{{{settings.name + ".json", std::move(json).text()}}, {}, {}};
}

}  // namespace tetralight::detail
