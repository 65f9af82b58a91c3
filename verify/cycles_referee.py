# SPDX-License-Identifier: Apache-2.0
"""Run by Blender: `blender -b --python cycles_referee.py -- JOB.json`.

Imports a glTF scene and has Cycles measure the radiance that arrives at positions: panoramas of
few pixels, rendered with different seeds and projected to spherical harmonics. `tetralight verify
--referee cycles` writes the job and reads the result (verify/cycles_referee.h).
"""
import json
import math
import os
import sys

import bpy
import mathutils

try:
    import numpy
except ImportError:  # Debian's Blender looks for it beside the first python3 of PATH
    sys.path.append("/usr/lib/python3/dist-packages")
    import numpy
if "bool" not in vars(numpy):  # the importer of Blender 3.4 uses the name, which NumPy 1.24 has not
    numpy.bool = bool

WIDTH, HEIGHT = 64, 32
SEEDS = 16
PILOT_SAMPLES = 4  # of each pixel
# With fewer samples of a pixel, the rounds of different seeds are not independent in Cycles 3.4, and
# their spread is smaller than their error.
LEAST_SAMPLES = 8


def blender_from_gltf(vector):
    return mathutils.Vector((vector[0], -vector[2], vector[1]))


def main(path):
    with open(path, encoding="utf-8") as file:
        job = json.load(file)
    with open(job["result"], "w", encoding="utf-8") as result:
        try:
            measure_all(job, result)
        except Exception as error:
            lines = [line for line in str(error).splitlines() if line and not line.startswith("Location")]
            reason = lines[-1] if lines else type(error).__name__
            result.write(json.dumps({"error": reason}) + "\n")
            raise


def measure_all(job, result):
    result.write(json.dumps({"version": bpy.app.version_string}) + "\n")
    scene = empty_scene()
    bpy.ops.import_scene.gltf(filepath=job["scene"], merge_vertices=False)
    remove_what_does_not_light()
    for material in bpy.data.materials:
        if material.use_nodes:
            make_diffuse(material)
    for light in job["lights"]:
        add_light(scene, light)
    scene.world = make_sky(job["sky"])
    camera = add_camera(scene)
    set_up_cycles(scene, job)
    view = Panorama(scene, camera, job)
    for i, position in enumerate(job["positions"]):
        result.write(json.dumps(view.measure(i, position)) + "\n")
        print(f"position {i + 1}", flush=True)


def empty_scene():
    bpy.ops.wm.read_factory_settings(use_empty=True)
    return bpy.context.scene


def inherited(thing, name):
    """A custom property of an object or of its nearest ancestor that has it."""
    while thing is not None:
        if name in thing.keys():
            return thing[name]
        thing = thing.parent
    return None


def remove_what_does_not_light():
    """Lights, cameras and moving objects. Lights are those of the job."""
    for thing in list(bpy.data.objects):
        moves = inherited(thing, "contribute_gi") in (False, 0)
        if thing.type in ("LIGHT", "CAMERA") or (thing.type == "MESH" and moves):
            bpy.data.objects.remove(thing)


class Nodes:
    """Adds nodes to a tree."""

    def __init__(self, tree):
        self.tree = tree

    def add(self, kind, inputs=(), **properties):
        """A node with values, or sockets of others, for its inputs of these indices or names."""
        node = self.tree.nodes.new("ShaderNode" + kind)
        for name, value in properties.items():
            setattr(node, name, value)
        for name, value in dict(inputs).items():
            if isinstance(value, bpy.types.NodeSocket):
                self.tree.links.new(value, node.inputs[name])
            else:
                node.inputs[name].default_value = value
        return node

    def math(self, operation, a, b, clamp=False):
        return self.add("Math", {0: a, 1: b}, operation=operation, use_clamp=clamp).outputs[0]

    def vector_math(self, operation, a, b):
        return self.add("VectorMath", {0: a, 1: b}, operation=operation).outputs[0]

    def scaled(self, vector, factor):
        node = self.add("VectorMath", {0: vector}, operation="SCALE")
        self.plug(node.inputs["Scale"], factor)
        return node.outputs[0]

    def plug(self, socket, value):
        if isinstance(value, bpy.types.NodeSocket):
            self.tree.links.new(value, socket)
        else:
            socket.default_value = value


def value_of(socket):
    """What is linked to a socket, or its own value."""
    if socket.is_linked:
        return socket.links[0].from_socket
    value = socket.default_value
    return tuple(value)[:3] if hasattr(value, "__len__") else value


def make_diffuse(material):
    """Replaces the surface of a material by what the baker bakes of it.

    Diffuse reflection with the albedo of docs/conventions.md; emission and reflection on the front
    of single-sided materials only.
    """
    tree = material.node_tree
    nodes = Nodes(tree)
    output = next(node for node in tree.nodes if node.type == "OUTPUT_MATERIAL")
    principled = next((node for node in tree.nodes if node.type == "BSDF_PRINCIPLED"), None)
    if principled is not None:
        surface = diffuse_surface(nodes, principled, bakes_emission(material))
        alpha = value_of(principled.inputs["Alpha"])
    else:
        surface, alpha = unlit_surface(nodes, tree, bakes_emission(material))
    if material.use_backface_culling:
        black = nodes.add("BsdfDiffuse", {"Color": (0, 0, 0, 1)}).outputs[0]
        behind = nodes.add("NewGeometry").outputs["Backfacing"]
        surface = nodes.add("MixShader", {0: behind, 1: surface, 2: black}).outputs[0]
    if isinstance(alpha, bpy.types.NodeSocket) or alpha < 1.0:
        clear = nodes.add("BsdfTransparent").outputs[0]
        surface = nodes.add("MixShader", {0: alpha, 1: clear, 2: surface}).outputs[0]
    tree.links.new(surface, output.inputs["Surface"])


def bakes_emission(material):
    return material.get("bake_emission", True) not in (False, 0, "none")


def diffuse_surface(nodes, principled, emits):
    """base · ((1 − m) 0.96 + m r / 2) + (1 − m) 0.04 r / 2, as the baker has it."""
    base, metallic, roughness = (value_of(principled.inputs[name]) for name in
                                 ("Base Color", "Metallic", "Roughness"))
    wide = nodes.math("MULTIPLY", roughness, 0.5)
    dielectric = nodes.math("SUBTRACT", 1.0, metallic)
    per_color = nodes.math("ADD", nodes.math("MULTIPLY", dielectric, 0.96),
                           nodes.math("MULTIPLY", metallic, wide))
    colorless = nodes.math("MULTIPLY", nodes.math("MULTIPLY", dielectric, 0.04), wide)
    grey = nodes.add("CombineXYZ", {0: colorless, 1: colorless, 2: colorless}).outputs[0]
    albedo = nodes.vector_math("ADD", nodes.scaled(base, per_color), grey)
    diffuse = nodes.add("BsdfDiffuse", {"Color": albedo}).outputs[0]
    if not emits:
        return diffuse
    color = value_of(principled.inputs["Emission"])
    strength = value_of(principled.inputs["Emission Strength"])
    if color == (0.0, 0.0, 0.0) or strength == 0.0:
        return diffuse
    color = color if isinstance(color, bpy.types.NodeSocket) else (*color, 1.0)
    emission = nodes.add("Emission", {"Color": color, "Strength": strength}).outputs[0]
    return nodes.add("AddShader", {0: diffuse, 1: emission}).outputs[0]


def unlit_surface(nodes, tree, emits):
    """Unlit materials emit their base colour and reflect nothing."""
    emitter = next((node for node in tree.nodes if node.type in ("EMISSION", "BACKGROUND")), None)
    if emitter is None or not emits:
        return nodes.add("BsdfDiffuse", {"Color": (0, 0, 0, 1)}).outputs[0], 1.0
    color = value_of(emitter.inputs["Color"])
    color = color if isinstance(color, bpy.types.NodeSocket) else (*color, 1.0)
    mixers = [node for node in tree.nodes if node.type == "MIX_SHADER"]
    clear = [node for node in mixers if any(
        link.from_node.type == "BSDF_TRANSPARENT" for link in node.inputs[1].links)]
    alpha = next((value_of(node.inputs[0]) for node in clear if not node.inputs[0].is_linked
                  or node.inputs[0].links[0].from_node.type != "LIGHT_PATH"), 1.0)
    return nodes.add("Emission", {"Color": color, "Strength": 1.0}).outputs[0], alpha


def add_light(scene, light):
    """`light`: as probe volumes store it. Intensities are those that Cycles renders."""
    kind = {"directional": "SUN", "point": "POINT", "spot": "SPOT"}.get(light["type"], "AREA")
    lamp = bpy.data.lights.new(light["type"], kind)
    brightest = max(light["intensity"])
    lamp.color = [value / brightest for value in light["intensity"]]
    if kind == "SUN":
        lamp.energy, lamp.angle = brightest, 2 * light["radius"]
    elif kind == "AREA":
        lamp.energy = 4 * brightest
        lamp.shape = "DISK" if light["type"] == "disc" else "RECTANGLE"
        lamp.size = 2 * light["radius"] if light["type"] == "disc" else light["width"]
        lamp.size_y = light["height"]
    else:
        lamp.energy, lamp.shadow_soft_size = 4 * math.pi * brightest, light["radius"]
    if kind == "SPOT":
        lamp.spot_size, lamp.spot_blend = 2 * math.acos(light["cos_outer_cone"]), 0.0
    if kind != "SUN" and light["type"] in ("point", "spot"):
        shape_light(lamp, light)
    lamp.cycles.use_multiple_importance_sampling = True
    thing = bpy.data.objects.new(light["type"], lamp)
    thing.matrix_world = light_matrix(light)
    thing.visible_camera = False
    scene.collection.objects.link(thing)


def light_matrix(light):
    """Blender's lights shine along −Z; the width of rectangles is along X."""
    z = -blender_from_gltf(light["direction"])
    x = blender_from_gltf(light["tangent"])
    x = x - x.dot(z) * z
    if x.length < 1e-3:
        x = z.orthogonal()
    x.normalize()
    columns = (x, z.cross(x), z, blender_from_gltf(light["position"]))
    matrix = mathutils.Matrix.Identity(4)
    for i, column in enumerate(columns):
        for row in range(3):
            matrix[row][i] = column[row]
    return matrix


def shape_light(lamp, light):
    """The ramp of spot cones and the end of ranges, which Blender's lamps do not have."""
    factors = []
    lamp.use_nodes = True
    nodes = Nodes(lamp.node_tree)
    if light["type"] == "spot" and light["cos_inner_cone"] > light["cos_outer_cone"]:
        incoming = nodes.add("NewGeometry").outputs["Incoming"]
        axis = blender_from_gltf(light["direction"])
        dot = nodes.add("VectorMath", {0: incoming, 1: axis}, operation="DOT_PRODUCT").outputs[1]
        width = light["cos_inner_cone"] - light["cos_outer_cone"]
        ramp = nodes.math("DIVIDE", nodes.math("SUBTRACT", dot, light["cos_outer_cone"]), width, True)
        factors.append(nodes.math("MULTIPLY", ramp, ramp))
    if light["range"] > 0:
        distance = nodes.add("LightPath").outputs["Ray Length"]
        share = nodes.math("POWER", nodes.math("DIVIDE", distance, light["range"]), 4.0)
        end = nodes.math("SUBTRACT", 1.0, share, True)
        factors += [end] * (2 if light["falloff"] == "inverse_square_range" else 1)
    strength = 1.0
    for factor in factors:
        strength = nodes.math("MULTIPLY", strength, factor)
    nodes.plug(lamp.node_tree.nodes["Emission"].inputs["Strength"], strength)


def make_sky(sky):
    world = bpy.data.worlds.new("sky")
    world.use_nodes = True
    tree = world.node_tree
    background = tree.nodes["Background"]
    nodes = Nodes(tree)
    if "image" in sky:
        place = nodes.add("TexCoord").outputs["Generated"]
        turn = (0.0, 0.0, -sky["rotation"])
        mapping = nodes.add("Mapping", {"Vector": place, "Rotation": turn}).outputs[0]
        image = bpy.data.images.load(sky["image"])
        image.colorspace_settings.is_data = True
        picture = nodes.add("TexEnvironment", {"Vector": mapping}, image=image).outputs[0]
        color = nodes.vector_math("MULTIPLY", picture, sky["radiance"])
    else:
        color = (*sky["radiance"], 1.0)
    nodes.plug(background.inputs["Color"], color)
    background.inputs["Strength"].default_value = 1.0
    return world


def add_camera(scene):
    camera = bpy.data.cameras.new("panorama")
    camera.type = "PANO"
    camera.cycles.panorama_type = "EQUIRECTANGULAR"
    camera.clip_start, camera.clip_end = 1e-6, 1e9
    scene.camera = bpy.data.objects.new("panorama", camera)
    scene.camera.rotation_euler = (math.pi / 2, 0, 0)  # looks along +Y, with +Z up
    scene.collection.objects.link(scene.camera)
    return scene.camera


def set_up_cycles(scene, job):
    """All that Cycles does by default at the cost of a bias is turned off."""
    scene.render.engine = "CYCLES"
    cycles = scene.cycles
    cycles.device = "CPU"
    cycles.use_denoising = cycles.use_adaptive_sampling = cycles.use_fast_gi = False
    cycles.sample_clamp_direct = cycles.sample_clamp_indirect = 0.0
    cycles.light_sampling_threshold = cycles.blur_glossy = 0.0
    cycles.pixel_filter_type, cycles.filter_width = "BOX", 1.0
    # A reflection that is lit by a lamp is one bounce less for Cycles.
    bounces = min(job["bounces"] - 1, 1024)
    cycles.max_bounces = cycles.diffuse_bounces = bounces
    cycles.min_light_bounces = cycles.min_transparent_bounces = 0
    cycles.transparent_max_bounces = 1024
    render = scene.render
    render.resolution_x, render.resolution_y, render.resolution_percentage = WIDTH, HEIGHT, 100
    render.use_persistent_data = True
    render.image_settings.file_format, render.image_settings.color_depth = "OPEN_EXR", "32"
    render.image_settings.color_mode = "RGB"
    render.filepath = os.path.join(job["folder"], "panorama.exr")
    render.use_overwrite = True
    if job["threads"] > 0:
        render.threads_mode, render.threads = "FIXED", job["threads"]


def sh_basis(x, y, z):
    """Of docs/conventions.md."""
    return numpy.stack([
        numpy.full_like(x, 0.28209479177387814), 0.4886025119029199 * y, 0.4886025119029199 * z,
        0.4886025119029199 * x, 1.0925484305920792 * x * y, 1.0925484305920792 * y * z,
        0.31539156525252005 * (3 * z * z - 1), 1.0925484305920792 * x * z,
        0.5462742152960396 * (x * x - y * y)])


def projection():
    """Nine weights of each pixel: the integral of the basis over the pixel, at its centre.

    Rows begin at the bottom of the picture. Solid angles of pixels are exact.
    """
    polar = (numpy.arange(HEIGHT) + 0.5) / HEIGHT * math.pi  # from straight down
    edges = numpy.cos(numpy.arange(HEIGHT + 1) / HEIGHT * math.pi)
    solid_angle = (edges[:-1] - edges[1:]) * 2 * math.pi / WIDTH
    turn = (numpy.arange(WIDTH) + 0.5) / WIDTH * 2 * math.pi - math.pi  # to the right of +Y
    up = numpy.repeat(-numpy.cos(polar)[:, None], WIDTH, axis=1)
    right = numpy.sin(polar)[:, None] * numpy.sin(turn)
    ahead = numpy.sin(polar)[:, None] * numpy.cos(turn)
    return sh_basis(right, up, -ahead) * solid_angle[:, None]  # axes of glTF


class Panorama:
    def __init__(self, scene, camera, job):
        self.scene, self.camera, self.job = scene, camera, job
        self.weights = projection()

    def render(self, seed, samples):
        """Nine RGB coefficients of the radiance."""
        self.scene.cycles.seed, self.scene.cycles.samples = seed, samples
        bpy.ops.render.render(write_still=True)
        image = bpy.data.images.load(self.scene.render.filepath)
        pixels = numpy.empty(WIDTH * HEIGHT * 4, numpy.float32)
        image.pixels.foreach_get(pixels)
        bpy.data.images.remove(image)
        pixels = pixels.reshape(HEIGHT, WIDTH, 4)[:, :, :3].astype(numpy.float64)
        return numpy.einsum("iyx,yxc->ic", self.weights, pixels)

    def rounds(self, seed, samples):
        return numpy.array([self.render((seed + i) % 2**31, samples) for i in range(SEEDS)])

    def measure(self, index, position):
        """`samples`: paths; `coefficients`: of each round."""
        self.camera.location = blender_from_gltf(position)
        seed = self.job["seed"] + index * 2 * SEEDS
        samples = self.job["samples"]
        if samples == 0:
            samples = self.enough(self.rounds(seed, PILOT_SAMPLES), self.job["target_errors"][index])
        else:
            samples = max(LEAST_SAMPLES, math.ceil(samples / (WIDTH * HEIGHT * SEEDS)))
        rounds = self.rounds(seed + SEEDS, samples)
        return {"samples": samples * WIDTH * HEIGHT * SEEDS, "coefficients": rounds.tolist()}

    def enough(self, pilot, target):
        """Samples of each pixel with which the mean light gets the error that is aimed at."""
        light = pilot[:, 0, :]
        mean = light.mean(axis=0)
        error = light.std(axis=0, ddof=1) / math.sqrt(SEEDS)
        floor = numpy.maximum(mean, 0.01 * mean.max())
        if floor.max() <= 0:
            return LEAST_SAMPLES
        factor = (error / (target * numpy.maximum(floor, 1e-30))).max() ** 2
        most = self.job["max_samples"] // (WIDTH * HEIGHT * SEEDS)
        return max(LEAST_SAMPLES, min(math.ceil(PILOT_SAMPLES * factor), most))


if __name__ == "__main__":
    main(sys.argv[sys.argv.index("--") + 1])
