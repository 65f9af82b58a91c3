# SPDX-License-Identifier: Apache-2.0
"""Marks of the panels are the custom properties, and arrive in the file as Tetralight reads them."""
import json

import addon_utils
import bpy
from blender_test import BlenderTest, add, add_lamp, add_plane, add_probes, command
from tetralight import marks


class Registration(BlenderTest):
    def test_the_add_on_can_be_disabled_and_enabled_again(self):
        for _ in range(2):
            addon_utils.disable("tetralight", default_set=True)
            self.assertFalse(hasattr(bpy.types.Object, "tetralight_contribute_gi"))
            self.assertFalse(hasattr(bpy.types.Scene, "tetralight"))
            self.assertFalse(hasattr(bpy.types, "TETRALIGHT_PT_bake"))
            addon_utils.enable("tetralight", default_set=True)
            self.assertTrue(hasattr(bpy.types.Object, "tetralight_contribute_gi"))
            self.assertTrue(hasattr(bpy.types, "TETRALIGHT_PT_bake"))

    def test_reading_marks_stores_nothing(self):
        thing = add("thing", bpy.data.meshes.new("mesh"))
        for name in marks.OBJECT:
            getattr(thing, marks.PREFIX + name)
        self.assertEqual(list(thing.keys()), [])


class Objects(BlenderTest):
    def setUp(self):
        super().setUp()
        self.thing = add_plane()
        self.thing.name = "thing"

    def test_an_object_without_marks_has_no_extras(self):
        self.assertEqual(self.extras_of("thing"), {})

    def test_roles(self):
        self.thing.tetralight_contribute_gi = "0"
        self.assertEqual(self.extras_of("thing"), {"contribute_gi": 0})
        self.thing.tetralight_contribute_gi = "1"
        self.assertEqual(self.extras_of("thing"), {"contribute_gi": 1})
        self.thing.tetralight_contribute_gi = "DEFAULT"
        self.assertEqual(self.extras_of("thing"), {})

    def test_words_and_numbers(self):
        self.thing.tetralight_receive_gi = "PROBES"
        self.thing.tetralight_light_probes = "PROXY_VOLUME"
        self.thing.tetralight_probe_anchor = "hook"
        self.thing.tetralight_use_lightmap_scale = True
        self.thing.tetralight_lightmap_scale = 2.5
        self.thing.tetralight_walkable = "1"
        self.thing.tetralight_in_reflections = "0"
        self.thing.tetralight_stitch_seams = "0"
        self.assertEqual(self.extras_of("thing"), {
            "receive_gi": "probes", "light_probes": "proxy_volume", "probe_anchor": "hook", "lightmap_scale": 2.5,
            "walkable": 1, "in_reflections": 0, "stitch_seams": 0})

    def test_a_number_that_is_switched_off_is_absent(self):
        self.thing.tetralight_lightmap_scale = 2.5
        self.thing.tetralight_use_lightmap_scale = False
        self.assertEqual(list(self.thing.keys()), [])
        self.assertEqual(self.thing.tetralight_lightmap_scale, 1)

    def test_panels_show_properties_that_were_typed_in(self):
        self.thing["contribute_gi"] = False
        self.thing["lightmap_scale"] = 3
        self.assertEqual(self.thing.tetralight_contribute_gi, "0")
        self.assertTrue(self.thing.tetralight_use_lightmap_scale)
        self.assertEqual(self.thing.tetralight_lightmap_scale, 3)

    def test_emission_of_materials(self):
        material = bpy.data.materials.new("glow")
        material.use_nodes = True
        material.tetralight_bake_emission = "NONE"
        self.thing.data.materials.append(material)
        exported, = self.exported()["materials"]
        self.assertEqual(exported["extras"], {"bake_emission": "none"})


class Groups(BlenderTest):
    def test_layers_are_a_list_and_absent_if_all_are_on(self):
        group = add_probes((0, 0, 1))
        self.assertEqual(list(group.tetralight_rendering_layers), [True] * 32)
        group.tetralight_rendering_layers = [i in (0, 3) for i in range(32)]
        group.tetralight_dering = True
        extras = {"light_probe_group": 1, "dering": 1, "rendering_layers": [0, 3]}
        self.assertEqual(self.extras_of("group"), extras)
        group.tetralight_rendering_layers = [True] * 32
        group.tetralight_dering = False
        self.assertEqual(self.extras_of("group"), {"light_probe_group": 1})

    def test_an_added_group_is_a_lattice_of_loose_vertices(self):
        add_plane()
        bpy.ops.tetralight.add_probe_group(size=(4, 2, 1), spacing=1, location=(0, 0, 2))
        self.assertEqual(len(bpy.context.object.data.vertices), 5 * 3 * 2)
        explained = command("explain", self.export())
        self.assertIn("Probes", explained)
        bpy.ops.tetralight.bake()
        group, = self.info(self.output)["group_list"]
        self.assertEqual((group["name"], self.info(self.output)["probes"]), ("Probes", 30))

    def test_a_group_of_too_many_probes_is_refused(self):
        error = self.refusal(bpy.ops.tetralight.add_probe_group, size=(1000, 1000, 1000), spacing=1)
        self.assertIn("choose a wider spacing", error)


class Helpers(BlenderTest):
    def test_adjustment_volumes(self):
        bpy.ops.tetralight.add_helper(kind="BOX", location=(0, 0, 1))
        box = bpy.context.object
        box.tetralight_adjustment_forbid = "1"
        box.tetralight_adjustment_use_spacing = True
        box.tetralight_adjustment_spacing = 0.5
        box.tetralight_adjustment_validity = 0.25
        box.tetralight_adjustment_rendering_layers = [i == 4 for i in range(32)]
        document = self.exported()
        node = self.node(document, box.name)
        self.assertEqual(node["extras"], {"probe_adjustment": {
            "shape": "box", "forbid": 1, "spacing": 0.5, "validity": 0.25, "rendering_layers": [4]}})
        self.assertEqual(node["scale"], [2, 2, 2])
        box.tetralight_adjustment_shape = "SPHERE"
        self.assertEqual(self.extras_of(box.name)["probe_adjustment"]["shape"], "sphere")

    def test_the_command_reads_each_helper(self):
        add_plane()
        for kind in ("BOX", "SPHERE", "REFLECTION", "PORTAL"):
            bpy.ops.tetralight.add_helper(kind=kind, location=(0, 0, 2))
        bpy.data.objects["Reflection Probe"].tetralight_reflection_use_importance = True
        bpy.data.objects["Reflection Probe"].tetralight_reflection_importance = 2
        parts = {part["name"]: part for part in json.loads(command("explain", self.export(), "--json"))["parts"]}
        counts = {"adjustment volumes": 2, "reflection probes": 1, "portals": 1}
        for name, count in counts.items():
            self.assertEqual((parts[name]["use"], parts[name]["count"]), ("read", count))


class Lights(BlenderTest):
    def test_marks_of_lights(self):
        lamp = add_lamp("POINT", 100).data
        lamp.tetralight_mode = "BAKED"
        lamp.tetralight_use_indirect_multiplier = True
        lamp.tetralight_indirect_multiplier = 2
        exported, = self.exported()["extensions"]["KHR_lights_punctual"]["lights"]
        self.assertEqual(exported["extras"]["mode"], "baked")
        self.assertEqual(exported["extras"]["indirect_multiplier"], 2)
        lamp.tetralight_mode = "DEFAULT"
        exported, = self.exported()["extensions"]["KHR_lights_punctual"]["lights"]
        self.assertNotIn("mode", exported["extras"])
