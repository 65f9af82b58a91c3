# SPDX-License-Identifier: Apache-2.0
"""Exported lights against pictures by Cycles: radiance of a small part of a diffuse plane below one light."""
import math

import bpy
import numpy
from blender_test import BlenderTest, add, add_lamp, add_plane, add_probes
from mathutils import Vector
from tetralight.probe_file import read_probes
from tetralight.show_probes import gltf_from_blender

ALBEDO = 0.8
HEIGHT = 2.0


class AgainstCycles(BlenderTest):
    def setUp(self):
        super().setUp()
        plane = add_plane(20)
        material = bpy.data.materials.new("diffuse")
        material.use_nodes = True
        nodes = material.node_tree.nodes
        nodes.clear()
        diffuse, output = nodes.new("ShaderNodeBsdfDiffuse"), nodes.new("ShaderNodeOutputMaterial")
        diffuse.inputs["Color"].default_value = (ALBEDO, ALBEDO, ALBEDO, 1)
        material.node_tree.links.new(diffuse.outputs["BSDF"], output.inputs["Surface"])
        plane.data.materials.append(material)

    def rendered_irradiance(self, normal=(0, 0, 1)):
        """RGB irradiance of the plane at the origin, from radiance = albedo / π · irradiance."""
        scene = bpy.context.scene
        camera = bpy.data.cameras.new("camera")
        camera.type, camera.ortho_scale = "ORTHO", 0.01
        scene.camera = add("camera", camera, normal)
        for thing in (scene.camera, bpy.data.objects["Plane"]):
            thing.rotation_mode = "QUATERNION"
            thing.rotation_quaternion = Vector(normal).to_track_quat("Z", "Y")
        scene.render.engine, scene.cycles.samples, scene.cycles.use_denoising = "CYCLES", 512, False
        scene.cycles.max_bounces = 0
        scene.render.resolution_x = scene.render.resolution_y = 4
        scene.render.image_settings.file_format = "OPEN_EXR"
        scene.render.image_settings.color_depth = "32"
        scene.render.filepath = str(self.folder / "picture.exr")
        bpy.ops.render.render(write_still=True)
        image = bpy.data.images.load(scene.render.filepath)
        return numpy.array(image.pixels).reshape(-1, 4)[:, :3].mean(axis=0) * math.pi / ALBEDO

    def light(self):
        """The exported light, its extras and RGB intensity."""
        exported, = self.exported()["extensions"]["KHR_lights_punctual"]["lights"]
        return exported, numpy.array(exported["color"]) * exported["intensity"]

    def assert_agree(self, exported):
        rendered = self.rendered_irradiance()
        self.assertGreater(rendered.min(), 0.05)
        numpy.testing.assert_allclose(exported, rendered, rtol=0.02)

    def test_points_and_their_colour(self):
        add_lamp("POINT", 100, (0, 0, HEIGHT), shadow_soft_size=0.01, color=(1, 0.5, 0.25))
        self.assert_agree(self.light()[1] / HEIGHT**2)

    def test_spots(self):
        add_lamp("SPOT", 100, (0, 0, HEIGHT), shadow_soft_size=0.01)
        self.assert_agree(self.light()[1] / HEIGHT**2)

    def test_suns(self):
        add_lamp("SUN", 3, (0, 0, HEIGHT))
        self.assert_agree(self.light()[1])

    def test_lamps_with_nodes(self):
        lamp = add_lamp("POINT", 100, (0, 0, HEIGHT), shadow_soft_size=0.01).data
        lamp.use_nodes = True
        lamp.node_tree.nodes["Emission"].inputs["Strength"].default_value = 2
        lamp.node_tree.nodes["Emission"].inputs["Color"].default_value = (1, 0.5, 0.25, 1)
        self.assert_agree(self.light()[1] / HEIGHT**2)

    def test_disks(self):
        """A Lambert disk of radius r lights the point below it with π L r² / (r² + d²)."""
        add_lamp("AREA", 100, (0, 0, HEIGHT), shape="DISK", size=2)
        exported, intensity = self.light()
        radius = exported["extras"]["radius"]
        radiance = intensity / (math.pi * radius**2)
        self.assert_agree(math.pi * radiance * radius**2 / (radius**2 + HEIGHT**2))

    def test_rectangles_that_are_scaled(self):
        lamp = add_lamp("AREA", 100, (0, 0, HEIGHT), shape="RECTANGLE", size=2, size_y=0.5)
        lamp.scale = (1.5, 3, 1)
        exported, intensity = self.light()
        sides = exported["extras"]["width"], exported["extras"]["height"]
        radiance = intensity / (sides[0] * sides[1])
        self.assert_agree(radiance * form_factor(*sides) * math.pi)

    def test_worlds(self):
        bpy.context.scene.world = bpy.data.worlds.new("world")
        bpy.context.scene.world.use_nodes = True
        bpy.context.scene.world.node_tree.nodes["Background"].inputs["Color"].default_value = (0.1, 0.2, 0.4, 1)
        bpy.context.scene.world.node_tree.nodes["Background"].inputs["Strength"].default_value = 2
        sky = self.exported()["scenes"][0]["extras"]["sky"]["radiance"]
        self.assert_agree(math.pi * numpy.array(sky))

    def image_world(self):
        """Brightest at one place of the horizon: light of the first two bands of SH, which probes hold exactly."""
        width, height = 256, 128
        u = (numpy.arange(width) + 0.5) / width
        polar = (numpy.arange(height)[:, None] + 0.5) / height * math.pi
        light = 1 + 0.8 * numpy.sin(polar) * numpy.cos(2 * math.pi * (u - 0.3))
        pixels = numpy.ones((height, width, 4))
        pixels[:, :, :3] = light[:, :, None] * (1, 0.5, 0.25)
        image = bpy.data.images.new("sky", width, height, float_buffer=True, is_data=True)
        image.pixels.foreach_set(pixels.astype(numpy.float32).ravel())
        world = bpy.data.worlds.new("world")
        world.use_nodes = True
        nodes, links = world.node_tree.nodes, world.node_tree.links
        picture, mapping, place = (nodes.new(f"ShaderNode{name}") for name in ("TexEnvironment", "Mapping", "TexCoord"))
        picture.image = image
        mapping.inputs["Rotation"].default_value[2] = math.radians(100)
        nodes["Background"].inputs["Strength"].default_value = 0.5
        links.new(place.outputs["Generated"], mapping.inputs["Vector"])
        links.new(mapping.outputs["Vector"], picture.inputs["Vector"])
        links.new(picture.outputs["Color"], nodes["Background"].inputs["Color"])
        bpy.context.scene.world = world
        return image

    def assert_image_is_sky(self):
        bpy.data.objects["Plane"].tetralight_contribute_gi = "0"  # the probe sees nothing but the sky
        add_probes((0, 0, 1))
        self.settings.samples = 4096
        bpy.ops.tetralight.bake()
        probes = read_probes(self.output)
        for normal in ((1, 0, 0), (0, 1, 0), (-1, 0, 0), (0, 0, 1)):
            with self.subTest(normal):
                rendered = self.rendered_irradiance(normal)
                baked = probes.irradiance(gltf_from_blender([normal]))[0, 0]
                numpy.testing.assert_allclose(baked, rendered, rtol=0.02)

    def test_an_image_without_a_file(self):
        self.image_world()
        self.assert_image_is_sky()

    def test_an_image_of_a_file(self):
        image = self.image_world()
        image.filepath_raw = str(self.folder / "sky.hdr")
        image.file_format = "HDR"
        image.save()
        self.assertFalse(image.is_dirty)
        self.assert_image_is_sky()


def form_factor(width, height, count=400):
    """Of a rectangle that a small surface faces below its middle: ∫ d² / (π r⁴) over its area."""
    x = (numpy.arange(count) + 0.5) / count * width - width / 2
    y = (numpy.arange(count) + 0.5) / count * height - height / 2
    squares = x[:, None] ** 2 + y[None, :] ** 2 + HEIGHT**2
    return (HEIGHT**2 / squares**2).sum() / math.pi * (width / count) * (height / count)
