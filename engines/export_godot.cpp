// SPDX-License-Identifier: Apache-2.0
// A text resource of type LightmapGIData for Godot 4, with probes and without lightmaps, and a
// script that shows it. Godot finds the tetrahedron of an object by a tree of planes that is part
// of the resource, and reads nine coefficients of radiance ÷ π of its corners.
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>

#include <tetralight/base/str_cat.h>
#include <tetralight/engines/detail/godot_tap.h>
#include <tetralight/engines/detail/targets.h>
#include <tetralight/engines/detail/xyz_text.h>
#include <tetralight/engines/escape.h>

namespace tetralight::detail {
namespace {

/// The constructor of a packed array. `append(text, i)` writes what belongs to element i.
template <class Append>
void append_packed(std::string& text, const char* type, size_t count, Append&& append) {
    text += type;
    text += '(';
    for (size_t i = 0; i < count; ++i) {
        if (i > 0) text += ", ";
        append(text, i);
    }
    text += ')';
}

/// Numbers separated by commas.
template <class... Numbers>
void append_list(std::string& text, Numbers... numbers) {
    const char* separator = "";
    ((text += separator, append_text(text, numbers), separator = ", "), ...);
}

void append_bsp(std::string& text, const std::vector<BspNode>& nodes) {
    append_packed(text, "PackedInt32Array", nodes.size(), [&](std::string& out, size_t i) {
        const BspNode& node = nodes[i];
        append_list(out, std::bit_cast<int32_t>(node.normal.x),
                    std::bit_cast<int32_t>(node.normal.y), std::bit_cast<int32_t>(node.normal.z),
                    std::bit_cast<int32_t>(node.distance), node.over, node.under);
    });
}

void append_light(std::string& text, const std::vector<IrradianceSh>& light) {
    append_packed(text, "PackedColorArray", light.size(), [&](std::string& out, size_t i) {
        const RadianceSh radiance = radiance_from_irradiance(light[i]);
        for (size_t k = 0; k < kShCoefficientCount; ++k) {
            const glm::vec3 color = radiance.coefficients[k] * std::numbers::inv_pi_v<float>;
            if (k > 0) out += ", ";
            append_list(out, color.r, color.g, color.b, 1);
        }
    });
}

std::string godot_resource(const BoxedCells& cells, const BspTree& tree) {
    const glm::vec3& low = cells.box.min;
    const glm::vec3 size = cells.box.size();
    std::string text =
        "[gd_resource type=\"LightmapGIData\" format=3]\n\n[resource]\nprobe_data = {\n"
        "\"baked_exposure\": 1.0,\n\"bounds\": AABB(";
    append_list(text, low.x, low.y, low.z, size.x, size.y, size.z);
    text += "),\n\"bsp\": ";
    append_bsp(text, tree.nodes);
    text += ",\n\"interior\": false,\n\"lightprobe_hash\": 0,\n\"points\": ";
    append_packed(text, "PackedVector3Array", cells.positions.size(),
                  [&](std::string& out, size_t i) {
                      const glm::vec3& p = cells.positions[i];
                      append_list(out, p.x, p.y, p.z);
                  });
    text += ",\n\"sh\": ";
    append_light(text, cells.light);
    text += ",\n\"tetrahedra\": ";
    append_packed(text, "PackedInt32Array", cells.tetrahedra.size(),
                  [&](std::string& out, size_t i) {
                      const auto& v = cells.tetrahedra[i];
                      append_list(out, v[0], v[1], v[2], v[3]);
                  });
    text += "\n}\n";
    return text;
}

constexpr const char* kGodotScript = R"gd(extends Node3D

@export var probes: LightmapGIData = preload(RESOURCE):
	set(value):
		probes = value
		if _lightmap.is_valid():
			_show_probes()

# Where the origin of the positions in the resource is in the level that was baked.
const ORIGIN := Vector3(POSITION)

var _lightmap := RID()
var _instance := RID()

func _enter_tree() -> void:
	_lightmap = RenderingServer.lightmap_create()
	_show_probes()
	_instance = RenderingServer.instance_create2(_lightmap, get_world_3d().scenario)
	set_notify_transform(true)
	_move_instance()

func _exit_tree() -> void:
	RenderingServer.free_rid(_instance)
	RenderingServer.free_rid(_lightmap)
	_instance = RID()
	_lightmap = RID()

func _notification(what: int) -> void:
	if what == NOTIFICATION_TRANSFORM_CHANGED and _instance.is_valid():
		_move_instance()

func _move_instance() -> void:
	var place := global_transform * Transform3D(Basis(), ORIGIN)
	RenderingServer.instance_set_transform(_instance, place)

func _show_probes() -> void:
	var data: Dictionary = probes.get("probe_data")
	RenderingServer.lightmap_set_probe_bounds(_lightmap, data["bounds"])
	RenderingServer.lightmap_set_probe_interior(_lightmap, data["interior"])
	RenderingServer.lightmap_set_probe_capture_data(
			_lightmap, data["points"], data["sh"], data["tetrahedra"], data["bsp"])
	RenderingServer.lightmap_set_baked_exposure_normalization(
			_lightmap, data["baked_exposure"])
)gd";

std::string godot_script(const std::string& resource_name, const glm::dvec3& origin) {
    std::string text = kGodotScript;
    const auto replace = [&](std::string_view word, const std::string& value) {
        text.replace(text.find(word), word.size(), value);
    };
    replace("RESOURCE", quoted_for_godot(resource_name));
    // GDScript reads 5e+20 but not 5e20, which `xyz_text` does not write.
    replace("POSITION", xyz_text(origin));
    return "# Lights objects by light probes, without a LightmapGI node. Set \"Mode\" of their\n"
           "# \"Global Illumination\" to \"Dynamic\". \"probes\" may change while the game "
           "runs.\n" +
           text;
}

std::vector<std::string> godot_notes(const ProbeVolumeView& volume, const BoxedCells& cells,
                                     const BspTree& tree) {
    const double nodes = static_cast<double>(tree.nodes.size());
    const double tetrahedra = static_cast<double>(cells.tetrahedra.size());
    std::vector<std::string> notes{str_cat(
        "Light outside of the probes is interpolated to the corners of the bounds; the "
        "tree that finds ",
        cells.tetrahedra.size(), " tetrahedra has ", std::round(100.0 * nodes / tetrahedra) / 100.0,
        " nodes for each and depth ", tree.depth, ".")};
    if (volume.info.world_origin != glm::dvec3(0.0)) {
        notes.push_back(str_cat("Positions are relative to ", xyz_text(volume.info.world_origin),
                                ", because Godot's are floats: put a LightmapGI node there. The "
                                "script does so."));
    }
    return notes;
}

}  // namespace

Result<ExportedVolume> export_godot(const ProbeVolumeView& volume, const ExportSettings& settings) {
    if (volume.positions.empty()) {
        return Error{ErrorCode::InvalidArgument, "has no probes; Godot needs at least one"};
    }
    const BoxedCells cells = boxed_cells(volume);
    const BspTree tree = make_bsp_tree(cells.positions, cells.tetrahedra);
    const auto tap = [&](const glm::dvec3& position) {
        return tap_godot_light(cells, tree, glm::vec3(position - volume.info.world_origin));
    };
    const std::string name = settings.name + ".tres";
    return ExportedVolume{
        {{name, godot_resource(cells, tree)},
         {settings.name + ".gd", godot_script(name, volume.info.world_origin)}},
        godot_notes(volume, cells, tree),
        measure_difference(volume, random_places(volume, kDifferencePlaces), tap)};
}

}  // namespace tetralight::detail
