# SPDX-License-Identifier: Apache-2.0
"""Exported scenes have the light that Blender renders. Each has one light and one probe, whose light is known."""
import json
import math

import bpy
from blender_test import BlenderTest, add, add_lamp, add_plane, add_probes, command
from tetralight.world import sky_of

PROBE = (0, 0, 1)  # in Blender's axes
UP = (0, 1, 0)  # in glTF's axes, as the following two
DOWN = (0, -1, 0)
# The irradiance of a surface that faces a small light, by nine coefficients: 1/4 + 1/2 + 5/16 of the true one.
FACING = 1.0625


def irradiance(coefficients, normal):
    """RGB, as docs/conventions.md has it."""
    x, y, z = normal
    basis = [0.282095, 0.488603 * y, 0.488603 * z, 0.488603 * x, 1.092548 * x * y, 1.092548 * y * z,
             0.315392 * (3 * z * z - 1), 1.092548 * x * z, 0.546274 * (x * x - y * y)]
    return [sum(value * rgb[channel] for value, rgb in zip(basis, coefficients)) for channel in range(3)]


class ExportTest(BlenderTest):
    def bake(self, samples=4096):
        self.settings.samples = samples
        self.assertEqual(bpy.ops.tetralight.bake(), {"FINISHED"})

    def baked(self, normal, samples=4096):
        """RGB irradiance at the probe."""
        add_probes(PROBE)
        self.bake(samples)
        x, y, z = PROBE
        return irradiance(self.irradiance_sh(self.output, (x, z, -y)), normal)

    def assert_near(self, value, expected, tolerance=1e-4):
        self.assertLess(abs(value / expected - 1), tolerance, f"{value}, not {expected}")

    def lights(self):
        return self.exported()["extensions"]["KHR_lights_punctual"]["lights"]


class Lights(ExportTest):
    def assert_lamp_lights(self, kind):
        lamp = add_lamp(kind, 1000, shadow_soft_size=0, color=(1, 0.5, 0.25)).data
        lamp.tetralight_mode = "BAKED"
        red, green, blue = self.baked(UP)
        self.assert_near(red, 1000 / (4 * math.pi) / 2**2 * FACING)
        self.assert_near(green, red / 2)
        self.assert_near(blue, red / 4)

    def test_points(self):
        self.assert_lamp_lights("POINT")

    def test_spots(self):
        self.assert_lamp_lights("SPOT")

    def test_suns(self):
        sun = add_lamp("SUN", 3, angle=0)
        sun.data.tetralight_mode = "BAKED"
        self.assert_near(self.baked(UP)[0], 3 * FACING)

    def test_emission_nodes_of_lamps_count(self):
        lamp = add_lamp("POINT", 10).data
        lamp.use_nodes = True
        emission = lamp.node_tree.nodes["Emission"]
        emission.inputs["Strength"].default_value = 3
        emission.inputs["Color"].default_value = (1, 0.5, 0, 1)
        exported, = self.lights()
        self.assert_near(exported["intensity"], 30 / (4 * math.pi), 1e-6)
        self.assertEqual(exported["color"], [1, 0.5, 0])

    def test_sizes_make_soft_shadows_unless_they_are_off(self):
        add_lamp("POINT", 10, shadow_soft_size=0.3)
        add_lamp("SUN", 1, angle=math.radians(2))
        add_lamp("SPOT", 10, shadow_soft_size=0.2).data["radius"] = 0.7
        extras = {light["type"]: light["extras"] for light in self.lights()}
        self.assertAlmostEqual(extras["point"]["radius"], 0.3, 6)
        self.assertAlmostEqual(extras["directional"]["angle"], 2, 5)
        self.assertEqual(extras["spot"]["radius"], 0.7)  # what the user gave stays
        self.settings.soft_shadows = False
        extras = {light["type"]: light.get("extras", {}) for light in self.lights()}
        self.assertEqual(extras, {"point": {}, "directional": {}, "spot": {"radius": 0.7}})


class AreaLights(ExportTest):
    """A small area light of P watts has P / 4 along its axis."""

    def area(self, **properties):
        lamp = add_lamp("AREA", 100, location=(0, 0, 3), **properties)
        lamp.data.tetralight_mode = "BAKED"
        return lamp

    def assert_lights_below(self):
        self.assert_near(self.baked(UP, 65536)[0], 100 / 4 / 2**2 * FACING, 2e-3)

    def test_rectangle(self):
        self.area(shape="RECTANGLE", size=0.05, size_y=0.02)
        self.assert_lights_below()

    def test_disk(self):
        self.area(shape="DISK", size=0.05)
        self.assert_lights_below()

    def test_it_has_its_sides_and_shines_to_one_side(self):
        lamp = self.area(shape="RECTANGLE", size=2, size_y=0.5)
        lamp.scale = (2, 3, 1)
        lamp.rotation_euler.z = math.radians(90)
        document = self.exported()
        exported, = document["extensions"]["KHR_lights_punctual"]["lights"]
        self.assertEqual((exported["extras"]["shape"], exported["extras"]["mode"]), ("rectangle", "baked"))
        self.assert_near(exported["extras"]["width"], 4, 1e-5)
        self.assert_near(exported["extras"]["height"], 1.5, 1e-5)
        lamp.location.z = 0  # below the probe, and shines down
        self.assertAlmostEqual(self.baked(DOWN, 64)[0], 0)

    def test_ellipses_are_rectangles_of_their_area(self):
        self.area(shape="ELLIPSE", size=2, size_y=1)
        extras = self.lights()[0]["extras"]
        self.assert_near(extras["width"] * extras["height"], math.pi * 1 * 0.5, 1e-5)
        self.assert_near(extras["width"] / extras["height"], 2, 1e-5)

    def test_the_scene_in_blender_stays(self):
        lamp = self.area(shape="DISK", size=0.05)
        before = (lamp.data.type, lamp.data.energy, list(lamp.keys()), list(lamp.data.keys()), len(bpy.data.lights))
        self.export()
        after = (lamp.data.type, lamp.data.energy, list(lamp.keys()), list(lamp.data.keys()), len(bpy.data.lights))
        self.assertEqual(after, before)
        self.assertEqual(list(bpy.context.scene.keys()), ["tetralight"])


class Sky(ExportTest):
    def world(self, color, strength=1.0):
        world = bpy.data.worlds.new("world")
        world.use_nodes = True
        background = world.node_tree.nodes["Background"].inputs
        background["Color"].default_value = (*color, 1)
        background["Strength"].default_value = strength
        bpy.context.scene.world = world
        return world

    def test_a_world_shines_from_everywhere(self):
        self.world((0.05, 0.1, 0.2), strength=2)
        for value, expected in zip(self.baked((0.6, -0.8, 0)), (0.1, 0.2, 0.4)):
            self.assert_near(value, expected * math.pi)

    def test_a_world_without_nodes_has_its_color(self):
        bpy.context.scene.world = bpy.data.worlds.new("world")
        bpy.context.scene.world.color = (0.5, 0.25, 0.125)
        self.assertEqual(self.exported()["scenes"][0]["extras"], {"sky": {"radiance": [0.5, 0.25, 0.125]}})

    def test_a_sky_of_the_scene_takes_precedence(self):
        self.world((1, 1, 1))
        bpy.context.scene["sky"] = 0.5
        self.assertEqual(self.exported()["scenes"][0]["extras"], {"sky": 0.5})

    def test_no_world_is_no_sky(self):
        self.assertNotIn("extras", self.exported()["scenes"][0])

    def test_other_worlds_are_left_out(self):
        world = self.world((1, 1, 1))
        noise = world.node_tree.nodes.new("ShaderNodeTexNoise")
        world.node_tree.links.new(noise.outputs["Color"], world.node_tree.nodes["Background"].inputs["Color"])
        self.assertNotIn("extras", self.exported()["scenes"][0])
        self.assertIn("neither constant nor", sky_of(bpy.context.scene).problem)

    def test_an_image_that_cannot_be_read_is_an_error(self):
        world = self.world((1, 1, 1))
        picture = world.node_tree.nodes.new("ShaderNodeTexEnvironment")
        picture.image = bpy.data.images.new("gone", 4, 4)
        picture.image.source = "FILE"
        picture.image.filepath = str(self.folder / "gone.hdr")
        world.node_tree.links.new(picture.outputs["Color"], world.node_tree.nodes["Background"].inputs["Color"])
        add_probes(PROBE)
        error = self.refusal(bpy.ops.tetralight.bake)
        self.assertIn('the image "gone" of the world', error)
        self.assertEqual(list(self.folder.iterdir()), [])


class Surfaces(ExportTest):
    def test_emission_is_radiance_and_modifiers_are_applied(self):
        material = bpy.data.materials.new("glow")
        material.use_nodes = True
        surface = material.node_tree.nodes["Principled BSDF"].inputs
        surface["Emission"].default_value = (1, 1, 1, 1)
        surface["Emission Strength"].default_value = 2
        plane = add_plane(1)
        plane.data.materials.append(material)
        for axis in (0, 1):  # 400 m wide
            array = plane.modifiers.new("array", "ARRAY")
            array.count = 400
            array.relative_offset_displace = (axis == 0, axis == 1, 0)
        plane.location = (-200, -200, 0)
        self.assert_near(self.baked(DOWN, 256)[0], 2 * math.pi, 0.02)

    def top(self):
        """The highest coordinate of the only mesh."""
        document = self.exported()
        position = document["meshes"][0]["primitives"][0]["attributes"]["POSITION"]
        return document["accessors"][position]["max"][1]

    def add_raised_plane(self):
        """By 1.5 m, through a shape key."""
        plane = add_plane()
        plane.shape_key_add(name="Basis")
        for point in plane.shape_key_add(name="up").data:
            point.co.z = 3
        plane.data.shape_keys.key_blocks["up"].value = 0.5
        return plane

    def test_shape_keys_count(self):
        """The file has them as morph targets, which the bake applies."""
        self.add_raised_plane()
        bounds = json.loads(command("explain", self.export(), "--json"))["bounds"]
        self.assertAlmostEqual(bounds["max"][1], 1.5, 5)

    def test_shape_keys_count_below_modifiers(self):
        self.add_raised_plane().modifiers.new("array", "ARRAY")
        self.assertAlmostEqual(self.top(), 1.5, 5)

    def test_poses_count(self):
        plane = add_plane()
        bpy.ops.object.armature_add()
        skeleton = bpy.context.object
        plane.vertex_groups.new(name="Bone").add(range(4), 1, "REPLACE")
        plane.modifiers.new("armature", "ARMATURE").object = skeleton
        skeleton.pose.bones["Bone"].location.y = 2  # along the bone, which is upright
        self.assertAlmostEqual(self.top(), 2, 5)

    def test_animated_objects_are_where_they_are_at_the_current_frame(self):
        plane = add_plane()
        for frame, height in ((1, 0), (11, 5)):
            plane.location.z = height
            plane.keyframe_insert("location", frame=frame)
        bpy.context.scene.frame_set(11)
        document = self.exported()
        self.assertEqual(self.node(document, "Plane")["translation"], [0, 5, 0])
        self.assertNotIn("animations", document)

    def test_linked_collections_have_their_light(self):
        """An instance of a collection with an area light: a node of its own, with the light."""
        lamp = add_lamp("AREA", 100, location=(0, 0, 3), shape="DISK", size=0.05)
        collection = bpy.data.collections.new("lamps")
        collection.objects.link(lamp)
        bpy.context.scene.collection.objects.unlink(lamp)
        for x in (-5, 5):
            instance = add("instance", None, (x, 0, 0))
            instance.instance_type, instance.instance_collection = "COLLECTION", collection
        nodes = [node for node in self.exported()["nodes"] if "KHR_lights_punctual" in node.get("extensions", {})]
        self.assertEqual(len(nodes), 2)

    def test_objects_that_are_off_in_renders_are_left_out(self):
        add_plane().hide_render = True
        self.assertNotIn("meshes", self.exported())

    def test_vertex_colors_count_if_a_node_reads_them(self):
        plane = add_plane()
        plane.data.color_attributes.new("color", "BYTE_COLOR", "CORNER")
        material = bpy.data.materials.new("colored")
        material.use_nodes = True
        plane.data.materials.append(material)

        def attributes():
            return self.exported()["meshes"][0]["primitives"][0]["attributes"]

        self.assertNotIn("COLOR_0", attributes())
        node = material.node_tree.nodes.new("ShaderNodeVertexColor")
        surface = material.node_tree.nodes["Principled BSDF"].inputs
        material.node_tree.links.new(node.outputs["Color"], surface["Base Color"])
        self.assertIn("COLOR_0", attributes())


class Failures(ExportTest):
    def test_a_folder_that_is_missing(self):
        error = self.refusal(bpy.ops.tetralight.export, filepath=str(self.folder / "none/scene.glb"))
        self.assertIn("none", error)

    def test_an_old_file_stays_if_the_exporter_is_off(self):
        path = self.folder / "scene.glb"
        path.write_bytes(b"old")
        bpy.ops.preferences.addon_disable(module="io_scene_gltf2")
        error = self.refusal(bpy.ops.tetralight.export, filepath=str(path))
        self.assertIn("glTF 2.0 is off", error)
        self.assertEqual(path.read_bytes(), b"old")
        self.assertEqual([entry.name for entry in self.folder.iterdir()], ["scene.glb"])
