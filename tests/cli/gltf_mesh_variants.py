# SPDX-License-Identifier: Apache-2.0
"""Variants of meshes, images and materials."""
import base64
import math
import struct

from gltf_scene import (
    BYTE, CODES, FLOAT, HALF, LEFT, OTHER, PAINT, RIGHT, SHORT, UBYTE, UINT, USHORT, blob, blob_bytes, box_mesh,
    deformed_box, flat_png, half_png, interlaced_png, linear, no_box, packed, painted, plain, png, reversed_box,
    set_uvs, textured, top_png)
from gltf_variant import variant, variants


# Accessors
def squeezed(count):
    """The box with its first vertices in its centre."""
    return lambda: plain(positions=[[0, 0, 0]] * count + box_mesh()[0][count:])


@variant("sparse positions", wrong=squeezed(6))
def _():
    gltf, positions = plain(positions=[[0, 0, 0]] * 6 + box_mesh()[0][6:]), box_mesh()[0]
    gltf.json["accessors"][gltf.box["attributes"]["POSITION"]]["sparse"] = {
        "count": 6, "indices": {"bufferView": gltf.view(bytes(range(6))), "componentType": UBYTE},
        "values": {"bufferView": gltf.view(packed(positions[:6]))}}
    return gltf


@variant("sparse positions of a target without a view", twin=lambda: deformed_box(lambda p: [p[0], p[1] * 2.5, p[2]]),
         wrong=plain)
def _():
    gltf, positions = plain(), box_mesh()[0]
    target = gltf.add("accessors", {
        "componentType": FLOAT, "count": 24, "type": "VEC3", "min": [0, -0.6, 0], "max": [0, 0.6, 0], "sparse": {
            "count": 24, "indices": {"bufferView": gltf.view(packed([[i] for i in range(24)], USHORT)),
                                     "componentType": USHORT},
            "values": {"bufferView": gltf.view(packed([[0, p[1] * 1.5, 0] for p in positions]))}}})
    gltf.box["targets"] = [{"POSITION": target}]
    gltf.json["meshes"][1]["weights"] = [1]
    return gltf


@variant("sparse indices", wrong=no_box)
def _():
    gltf, indices = plain(), box_mesh()[3]
    accessor = gltf.accessor([0] * 36, UBYTE)
    gltf.json["accessors"][accessor]["max"] = [23]
    gltf.json["accessors"][accessor]["sparse"] = {
        "count": 36, "indices": {"bufferView": gltf.view(packed([[i] for i in range(36)], UINT)),
                                 "componentType": UINT},
        "values": {"bufferView": gltf.view(bytes(indices))}}
    gltf.box["indices"] = accessor
    return gltf


@variant("interleaved attributes", wrong=lambda: plain(positions=squash(box_mesh()[0])))
def _():
    gltf, (positions, normals, uvs, _) = plain(), box_mesh()
    view = gltf.view(b"".join(packed([p, n, uv]) for p, n, uv in zip(positions, normals, uvs)), byteStride=32)
    for name, values, offset in (("POSITION", positions, 0), ("NORMAL", normals, 12), ("TEXCOORD_0", uvs, 24)):
        gltf.box["attributes"][name] = gltf.accessor(values, view=view, byteOffset=offset)
    return gltf


def squash(positions):
    return [p if i < 8 else [0, 0, 0] for i, p in enumerate(positions)]


@variant("byteStride and byteOffset", wrong=lambda: plain(positions=squash(box_mesh()[0])))
def _():
    gltf, positions = plain(), box_mesh()[0]
    view = gltf.view(bytes(8) + b"".join(packed([p]) + b"\xff" * 12 for p in positions), byteStride=24)
    gltf.box["attributes"]["POSITION"] = gltf.accessor(positions, view=view, byteOffset=8)
    return gltf


@variants({"u8": UBYTE, "u16": USHORT, "u32": UINT}, "{} indices", wrong=no_box)
def _(component):
    gltf = plain()
    gltf.box["indices"] = gltf.accessor(box_mesh()[3], component)
    return gltf


@variant("no indices", wrong=no_box)
def _():
    gltf, (positions, _, _, indices) = plain(), box_mesh()
    gltf.box["attributes"] = {"POSITION": gltf.accessor([positions[i] for i in indices])}
    del gltf.box["indices"]
    return gltf


def primitives(mode, corner_order):
    """The box as one primitive of each face."""
    gltf = plain()
    mesh = gltf.json["meshes"][1]
    template = {key: value for key, value in gltf.box.items() if key != "indices"}
    mesh["primitives"] = [{**template, "mode": mode,
                           "indices": gltf.accessor([4 * face + i for i in corner_order], USHORT)}
                          for face in range(6)]
    return gltf


@variant("strips", wrong=no_box)
def _():
    return primitives(5, (0, 1, 3, 2))


@variant("fans", wrong=no_box)
def _():
    return primitives(6, (0, 1, 2, 3))


@variant("one strip with triangles without area", wrong=no_box)
def _():
    gltf, order = plain(), []
    for face in range(6):
        corners = [4 * face + i for i in (0, 1, 3, 2)]
        order += ([order[-1], corners[0]] if order else []) + corners
    gltf.box.update(mode=5, indices=gltf.accessor(order, USHORT))
    return gltf


@variant("points and lines", told="lines")
def _():
    gltf = plain()
    for mode in (0, 1, 2, 3):
        gltf.json["meshes"][1]["primitives"].append({**gltf.box, "mode": mode})
    return gltf


@variant("no normals")
def _():
    gltf = plain()
    del gltf.box["attributes"]["NORMAL"]
    return gltf


@variant("default material", twin=lambda: white_box(), wrong=plain)
def _():
    gltf = plain()
    del gltf.box["material"]
    return gltf


def white_box():
    gltf = plain(color=[1, 1, 1])
    gltf.paint["pbrMetallicRoughness"].update(metallicFactor=1, roughnessFactor=1)
    return gltf


@variants({"u8": UBYTE, "u16": USHORT}, "normalized {} texture coordinates", wrong=painted(OTHER))
def _(component):
    gltf = textured(half_png())
    set_uvs(gltf, LEFT, component=component)
    return gltf


@variants({"u8 RGB": (UBYTE, 3), "u8 RGBA": (UBYTE, 4), "u16 RGB": (USHORT, 3), "u16 RGBA": (USHORT, 4),
           "float RGB": (FLOAT, 3), "float RGBA": (FLOAT, 4)}, "vertex colours: {}",
          twin=lambda: plain(color=[0.8, 0.4, 0.2]), wrong=lambda: plain(color=[1, 1, 1]))
def _(kind):
    component, size = kind
    largest = {UBYTE: 255, USHORT: 65535, FLOAT: 1}[component]
    color = [c * largest for c in (0.8, 0.4, 0.2, 1)[:size]]
    color = color if component == FLOAT else [round(c) for c in color]
    gltf = plain(color=[1, 1, 1])
    stride = -(-size * struct.calcsize(CODES[component]) // 4) * 4
    one = packed([color], component)
    view = gltf.view((one + bytes(stride - len(one))) * 24, byteStride=stride)
    gltf.box["attributes"]["COLOR_0"] = gltf.accessor([color] * 24, component, view=view,
                                                      **({} if component == FLOAT else {"normalized": True}))
    return gltf


@variant("a second set of vertex colours", told="COLOR_1")
def _():
    gltf = plain()
    gltf.box["attributes"]["COLOR_0"] = gltf.accessor([[1, 1, 1]] * 24)
    gltf.box["attributes"]["COLOR_1"] = gltf.accessor([[0, 0, 1]] * 24)
    return gltf


@variant("an attribute of a program", told="_BATCHID")
def _():
    gltf = plain()
    gltf.box["attributes"]["_BATCHID"] = gltf.accessor([1] * 24)
    return gltf


@variant("vertex colours of bytes that are not normalized", refused="normalized")
def _():
    gltf = plain(color=[1, 1, 1])
    view = gltf.view(bytes((204, 102, 51, 255)) * 24, byteStride=4)
    gltf.box["attributes"]["COLOR_0"] = gltf.accessor([[204, 102, 51, 255]] * 24, UBYTE, view=view)
    return gltf


@variant("texture coordinates of bytes that are not normalized", refused="normalized")
def _():
    gltf = textured(half_png())
    view = gltf.view(bytes((1, 0, 0, 0)) * 24, byteStride=4)
    gltf.box["attributes"]["TEXCOORD_0"] = gltf.accessor([[1, 0]] * 24, UBYTE, view=view)
    return gltf


@variant("an index that restarts a strip", refused="65535")
def _():
    gltf = plain()
    gltf.box.update(mode=5, indices=gltf.accessor([0, 1, 3, 2, 65535, 4, 5, 7, 6], USHORT))
    return gltf


@variant("corners that make no whole triangle", refused="whole triangles")
def _():
    gltf = plain()
    gltf.box["indices"] = gltf.accessor(box_mesh()[3][:-1], USHORT)
    return gltf


# Quantization and compression
@variants({"u8": (UBYTE, 240, False), "u16": (USHORT, 48000, False), "i8": (BYTE, 120, False),
           "i16": (SHORT, 30000, False), "normalized i16": (SHORT, 32767, True),
           "normalized u8": (UBYTE, 255, True)}, "quantized positions: {}", wrong=no_box, tolerance=1e-3)
def _(kind):
    component, largest, normalized = kind
    is_signed = component in (BYTE, SHORT)
    gltf = plain()
    steps = [[round((c / h if is_signed else (c / h + 1) / 2) * largest) for c, h in zip(p, HALF)]
             for p in box_mesh()[0]]
    code_size = struct.calcsize(CODES[component])
    stride = -(-3 * code_size // 4) * 4
    view = gltf.view(b"".join(packed([s], component) + bytes(stride - 3 * code_size) for s in steps), byteStride=stride)
    gltf.box["attributes"] = {"POSITION": gltf.accessor(steps, component, view=view,
                                                        **({"normalized": True} if normalized else {}))}
    one = 1 if normalized else largest
    scale = [h / one * (1 if is_signed else 2) for h in HALF]
    inner = gltf.add("nodes", {"name": "quantized", "mesh": 1, "scale": scale,
                               "translation": [0, 0, 0] if is_signed else [-h for h in HALF]})
    del gltf.node("box")["mesh"]
    gltf.node("box")["children"] = [inner]
    gltf.extension("KHR_mesh_quantization", required=True)
    return gltf


def draco(name, attributes):
    gltf, encoded = plain(), blob(name)
    view = gltf.view(base64.b64decode(encoded["data"]))
    primitive = gltf.box
    primitive["attributes"] = {key: primitive["attributes"][key] for key in attributes}
    for accessor in (primitive["indices"], *primitive["attributes"].values()):
        gltf.json["accessors"][accessor].pop("bufferView")
    gltf.extension("KHR_draco_mesh_compression", primitive,
                   {"bufferView": view, "attributes": {key: encoded["attributes"][key] for key in attributes}},
                   required=True)
    return gltf


@variants({"edgebreaker": "draco_edgebreaker", "sequential": "draco_sequential"}, "Draco, {}", wrong=no_box,
          tolerance=2e-3)
def _(name):
    return draco(name, ("POSITION", "NORMAL", "TEXCOORD_0"))


@variant("Draco with texture coordinates", wrong=painted(OTHER), tolerance=2e-3)
def _():
    gltf = draco("draco_edgebreaker", ("POSITION", "NORMAL", "TEXCOORD_0"))
    texture = gltf.texture(half_png(OTHER, PAINT))
    gltf.extension("KHR_texture_transform")
    gltf.paint["pbrMetallicRoughness"] = {"metallicFactor": 0, "baseColorTexture": {
        "index": texture, "extensions": {"KHR_texture_transform": {"scale": [0.25, 1], "offset": [0.625, 0]}}}}
    return gltf


@variant("Draco with a plain fallback", tolerance=2e-3, wrong=no_box)
def _():
    gltf, encoded = plain(), blob("draco_sequential")
    gltf.extension("KHR_draco_mesh_compression", gltf.box,
                   {"bufferView": gltf.view(base64.b64decode(encoded["data"])), "attributes": encoded["attributes"]})
    return gltf


def meshopt(target, name, count, stride, mode, filter=None, extension="EXT_meshopt_compression"):
    """Replaces the view of an accessor."""
    def change(gltf):
        data = blob_bytes(name)
        offset = gltf.json["bufferViews"][gltf.view(data)]["byteOffset"]
        fallback = {"byteLength": 0, "extensions": {extension: {"fallback": True}}}
        buffers = gltf.json.setdefault("buffers", [{}, fallback])
        begin = buffers[1]["byteLength"]
        buffers[1]["byteLength"] += count * stride + (-count * stride) % 4
        view = {"buffer": 1, "byteOffset": begin, "byteLength": count * stride, "extensions": {extension: {
            "buffer": 0, "byteOffset": offset, "byteLength": len(data), "byteStride": stride, "count": count,
            "mode": mode, **({"filter": filter} if filter else {})}}}
        if mode == "ATTRIBUTES":
            view["byteStride"] = stride
        accessor = gltf.json["accessors"][target(gltf)]
        accessor["bufferView"] = gltf.add("bufferViews", view)
        gltf.extension(extension, required=True)
        buffers[0]["byteLength"] = len(gltf.binary)
        return accessor
    return change


def of_positions(gltf):
    return gltf.box["attributes"]["POSITION"]


def of_indices(gltf):
    return gltf.box["indices"]


MESHOPT = {"positions": meshopt(of_positions, "meshopt_positions_v0", 24, 12, "ATTRIBUTES"),
           "exponential filter": meshopt(of_positions, "meshopt_exponential", 24, 12, "ATTRIBUTES", "EXPONENTIAL"),
           "triangles": meshopt(of_indices, "meshopt_triangles", 36, 2, "TRIANGLES"),
           "indices": meshopt(of_indices, "meshopt_indices", 36, 2, "INDICES")}


@variants(MESHOPT, "meshopt: {}", wrong=no_box, tolerance=2e-3)
def _(change):
    gltf = plain()
    change(gltf)
    return gltf


@variant("meshopt: 32-bit triangles", wrong=no_box, tolerance=2e-3)
def _():
    gltf = plain()
    accessor = meshopt(of_indices, "meshopt_triangles_32", 36, 4, "TRIANGLES")(gltf)
    accessor["componentType"] = UINT
    return gltf


@variant("meshopt: octahedral normals")
def _():
    gltf = plain()
    accessor = meshopt(lambda g: g.box["attributes"]["NORMAL"], "meshopt_octahedral", 24, 4, "ATTRIBUTES",
                       "OCTAHEDRAL")(gltf)
    accessor.update(componentType=BYTE, normalized=True, min=[-1] * 3, max=[1] * 3)
    gltf.extension("KHR_mesh_quantization", required=True)
    return gltf


@variant("meshopt: a later version of the encoder", refused="gltfpack -c")
def _():
    gltf = plain()
    meshopt(of_positions, "meshopt_positions_v1", 24, 12, "ATTRIBUTES")(gltf)
    return gltf


@variant("KHR_meshopt_compression, required", refused="EXT_meshopt_compression")
def _():
    gltf = plain()
    meshopt(of_positions, "meshopt_positions_v0", 24, 12, "ATTRIBUTES", extension="KHR_meshopt_compression")(gltf)
    return gltf


@variant("Draco of strips", refused="KHR_draco_mesh_compression")
def _():
    gltf = draco("draco_edgebreaker", ("POSITION", "NORMAL", "TEXCOORD_0"))
    gltf.box["mode"] = 5
    return gltf


# Images
GRAY = (150, 150, 150)


def gray16(value):
    return bytes([value, value])


PALETTE = (b"PLTE", bytes(PAINT) * 2)
PNGS = {"8 bits": flat_png(), "16 bits": flat_png(b"".join(gray16(c) for c in PAINT), 16),
        "alpha": flat_png(bytes(PAINT) + b"\x33", 8, 6),
        "16 bits with alpha": flat_png(b"".join(gray16(c) for c in PAINT) + b"\x33\x33", 16, 6),
        "palette of 8 bits": flat_png(b"\1", 8, 3, [PALETTE]), "palette of 4 bits": flat_png(b"\x11", 4, 3, [PALETTE]),
        "palette of 2 bits": flat_png(b"\x55", 2, 3, [PALETTE]), "palette of 1 bit": flat_png(b"\xff", 1, 3, [PALETTE]),
        "palette with alpha": flat_png(b"\1", 8, 3, [PALETTE, (b"tRNS", b"\xff\x33")]),
        "a transparent colour": flat_png(chunks=[(b"tRNS", b"".join(struct.pack(">H", c) for c in PAINT))]),
        "gamma of 1.0, which glTF ignores": flat_png(chunks=[(b"gAMA", struct.pack(">I", 100000))]),
        "an sRGB chunk": flat_png(chunks=[(b"sRGB", b"\0")]),
        "1 x 1": png(1, [bytes(PAINT)], 8, 2), "7 x 7": png(7, [bytes(PAINT) * 7] * 7, 8, 2)}


@variants(PNGS, "PNG: {}", wrong=white_box)
def _(image):
    return textured(image)


GRAYS = {"gray": flat_png(b"\x96", 8, 0), "gray of 16 bits": flat_png(b"\x96\x96", 16, 0),
         "gray with alpha": flat_png(b"\x96\x33", 8, 4)}


@variants(GRAYS, "PNG: {}", twin=painted(GRAY), wrong=white_box)
def _(image):
    return textured(image)


@variant("PNG: gray of 4 bits", twin=painted((153, 153, 153)), wrong=white_box)
def _():
    return textured(flat_png(b"\x99", 4, 0))


@variant("PNG: interlaced", wrong=painted(OTHER))
def _():
    return textured(interlaced_png(), LEFT)


@variants({"baseline": "jpeg", "progressive": "jpeg_progressive", "4:2:0": "jpeg_420"}, "JPEG: {}", wrong=white_box,
          tolerance=0.02)
def _(name):
    return textured(blob_bytes(name), mime="image/jpeg")


@variant("JPEG: gray", twin=painted((139, 139, 139)), wrong=white_box, tolerance=0.02)
def _():
    return textured(blob_bytes("jpeg_gray"), mime="image/jpeg")


@variant("JPEG: CMYK", wrong=painted(OTHER), tolerance=0.03)
def _():
    return textured(blob_bytes("jpeg_cmyk"), mime="image/jpeg")


@variant("PNG with the type of a JPEG", wrong=white_box)
def _():
    return textured(flat_png(), mime="image/jpeg")


def webp(name, fallback=None):
    gltf = textured(fallback or flat_png())
    image = gltf.add("images", {"bufferView": gltf.view(blob_bytes(name)), "mimeType": "image/webp"})
    if fallback is None:
        gltf.json["textures"][0].pop("source")
    gltf.extension("EXT_texture_webp", gltf.json["textures"][0], {"source": image}, required=fallback is None)
    return gltf


@variants({"lossless": "webp_lossless", "lossy": "webp_lossy", "alpha": "webp_alpha"}, "WebP: {}", wrong=white_box,
          tolerance=0.02)
def _(name):
    return webp(name)


@variant("WebP with a PNG beside it", wrong=white_box)
def _():
    return webp("webp_lossless", fallback=flat_png())


def basisu(has_fallback):
    gltf = textured(flat_png())
    ktx = gltf.add("images", {"bufferView": gltf.view(b"\xabKTX 20\xbb\r\n\x1a\n" + bytes(68)),
                              "mimeType": "image/ktx2"})
    if not has_fallback:
        gltf.json["textures"][0].pop("source")
    gltf.extension("KHR_texture_basisu", gltf.json["textures"][0], {"source": ktx}, required=not has_fallback)
    return gltf


@variant("Basis Universal with a PNG beside it", wrong=white_box)
def _():
    return basisu(True)


@variant("Basis Universal alone", refused="ktxdecompress")
def _():
    return basisu(False)


def other_image(extension, image, mime, has_fallback):
    gltf = textured(flat_png())
    source = gltf.add("images", {"bufferView": gltf.view(image), "mimeType": mime})
    if not has_fallback:
        gltf.json["textures"][0].pop("source")
    gltf.extension(extension, gltf.json["textures"][0], {"source": source}, required=not has_fallback)
    return gltf


@variant("AVIF with a PNG beside it", wrong=white_box)
def _():
    return other_image("EXT_texture_avif", blob_bytes("avif"), "image/avif", True)


@variant("AVIF with a PNG beside it, required", wrong=white_box)
def _():
    gltf = other_image("EXT_texture_avif", blob_bytes("avif"), "image/avif", True)
    gltf.json["extensionsRequired"] = ["EXT_texture_avif"]
    return gltf


@variant("AVIF alone", refused="PNG")
def _():
    return other_image("EXT_texture_avif", blob_bytes("avif"), "image/avif", False)


@variant("AVIF alone, not required", told="texture 0")
def _():
    gltf = other_image("EXT_texture_avif", blob_bytes("avif"), "image/avif", False)
    del gltf.json["extensionsRequired"]
    return gltf


@variant("DDS with a PNG beside it", wrong=white_box)
def _():
    return other_image("MSFT_texture_dds", b"DDS " + bytes(124), "image/vnd-ms.dds", True)


# Texture coordinates
@variant("a texture's origin at the top", wrong=painted(OTHER))
def _():
    return textured(top_png(), (0.1, 0.125, 0.9, 0.375))


@variant("the second set of texture coordinates", wrong=painted(OTHER))
def _():
    gltf = textured(half_png(), RIGHT, texCoord=1)
    set_uvs(gltf, LEFT, "TEXCOORD_1")
    return gltf


@variant("the third set of texture coordinates", refused="texCoord 2")
def _():
    gltf = textured(half_png(), RIGHT, texCoord=2)
    set_uvs(gltf, RIGHT, "TEXCOORD_1")
    set_uvs(gltf, LEFT, "TEXCOORD_2")
    return gltf


def texture_transform(area, image=None, texCoord=0, **values):
    gltf = textured(image or half_png(), area, texCoord=texCoord)
    use = gltf.paint["pbrMetallicRoughness"]["baseColorTexture"]
    gltf.extension("KHR_texture_transform", use, values, required=True)
    return gltf


@variant("KHR_texture_transform: offset", wrong=painted(OTHER))
def _():
    return texture_transform(RIGHT, offset=[-0.5, 0])


@variant("KHR_texture_transform: scale", wrong=painted(OTHER))
def _():
    return texture_transform(RIGHT, scale=[0.4, 1])


@variant("KHR_texture_transform: rotation", wrong=painted(OTHER))
def _():  # u' = u cos r + v sin r: right of the middle becomes left of it
    return texture_transform((0.625, -0.875, 0.875, -0.625), rotation=math.radians(60),
                             image=half_png(OTHER, PAINT), offset=[1.0, 0])


@variant("KHR_texture_transform: its set of coordinates", wrong=painted(OTHER))
def _():
    gltf = texture_transform(RIGHT, texCoord=1)
    use = gltf.paint["pbrMetallicRoughness"]["baseColorTexture"]
    use["texCoord"] = 0
    use["extensions"]["KHR_texture_transform"] = {"texCoord": 1}
    set_uvs(gltf, LEFT, "TEXCOORD_1")
    return gltf


REPEAT, CLAMP, MIRROR = 10497, 33071, 33648


@variants({"repeat": {"wrapS": REPEAT}, "repeat by default": {}}, "wrap in u: {}", wrong=painted(OTHER))
def _(sampler):
    return textured(half_png(), (2.125, 0.1, 2.375, 0.9), sampler=sampler)


@variant("wrap in u: mirror", wrong=painted(OTHER))
def _():  # 1.75 is 0.25 mirrored, and 0.75 repeated; clamped it is the right edge
    return textured(half_png(), (1.625, 0.1, 1.875, 0.9), sampler={"wrapS": MIRROR})


@variant("wrap in u: clamp", wrong=painted(OTHER))
def _():
    return textured(half_png(OTHER, PAINT), (2.125, 0.1, 2.375, 0.9), sampler={"wrapS": CLAMP})


@variant("wrap in v: mirror", wrong=painted(OTHER))
def _():
    return textured(top_png(), (0.1, 1.625, 0.9, 1.875), sampler={"wrapT": MIRROR})


@variant("wrap in v: clamp", wrong=painted(OTHER))
def _():
    return textured(top_png(OTHER, PAINT), (0.1, 2.125, 0.9, 2.375), sampler={"wrapT": CLAMP})


@variant("nearest filter", told="NEAREST")
def _():
    return textured(half_png(), LEFT, sampler={"magFilter": 9728, "minFilter": 9728})


# Materials
def changed(change, make=plain):
    def build():
        gltf = make()
        change(gltf)
        return gltf
    return build


def glowing(radiance):
    def change(gltf):
        gltf.paint["emissiveFactor"] = radiance
    return changed(change)


@variant("emissive strength", twin=glowing([2, 1, 0.5]), wrong=glowing([1, 0.5, 0.25]))
def _():
    gltf = glowing([1, 0.5, 0.25])()
    gltf.extension("KHR_materials_emissive_strength", gltf.paint, {"emissiveStrength": 2})
    return gltf


@variant("emissive texture", twin=glowing(linear(PAINT)), wrong=glowing([1, 1, 1]), tolerance=2e-3)
def _():
    gltf = glowing([1, 1, 1])()
    gltf.paint["emissiveTexture"] = {"index": gltf.texture(flat_png())}
    return gltf


@variant("unlit", twin=lambda: unlit_twin(), wrong=plain)
def _():
    gltf = plain()
    gltf.extension("KHR_materials_unlit", gltf.paint)
    return gltf


def unlit_twin():
    gltf = plain(color=[0, 0, 0])
    gltf.paint["pbrMetallicRoughness"].update(metallicFactor=1)
    gltf.paint["emissiveFactor"] = linear(PAINT)
    return gltf


@variant("metallic-roughness texture", twin=lambda: metal(), wrong=plain, tolerance=2e-3)
def _():
    gltf = plain()
    gltf.paint["pbrMetallicRoughness"].update(metallicFactor=1, roughnessFactor=1)
    texture = gltf.texture(flat_png(bytes([0, 51, 255])))  # roughness 0.2, metallic 1
    gltf.paint["pbrMetallicRoughness"]["metallicRoughnessTexture"] = {"index": texture}
    return gltf


def metal():
    gltf = plain()
    gltf.paint["pbrMetallicRoughness"].update(metallicFactor=1, roughnessFactor=0.2)
    return gltf


@variant("occlusion texture", told="occlusion")
def _():
    gltf = plain()
    gltf.paint["occlusionTexture"] = {"index": gltf.texture(flat_png(bytes([60, 0, 0])))}
    return gltf


@variant("normal map", wrong=no_box)
def _():
    gltf = plain()
    gltf.paint["normalTexture"] = {"index": gltf.texture(flat_png(bytes([128, 128, 255])))}
    return gltf


def alpha(mode, value, cutoff=None, vertex=None, image=None):
    def make():
        gltf = textured(image) if image else plain()
        gltf.paint["alphaMode"] = mode
        if not image:
            gltf.paint["pbrMetallicRoughness"]["baseColorFactor"][3] = value
        if cutoff is not None:
            gltf.paint["alphaCutoff"] = cutoff
        if vertex is not None:
            gltf.box["attributes"]["COLOR_0"] = gltf.accessor([[1, 1, 1, vertex]] * 24)
        return gltf
    return make


variant("MASK: cut away", twin=no_box, wrong=plain)(alpha("MASK", 0.45))
variant("MASK: kept", wrong=no_box)(alpha("MASK", 0.55))
variant("MASK: kept by its own cutoff", wrong=no_box)(alpha("MASK", 0.35, 0.3))
variant("MASK: cut away by its own cutoff", twin=no_box, wrong=plain)(alpha("MASK", 0.6, 0.7))
variant("MASK: alpha of vertices", twin=no_box, wrong=plain)(alpha("MASK", 0.6, vertex=0.6))
variant("MASK: alpha of a texture", twin=no_box, wrong=plain)(
    alpha("MASK", 1, image=flat_png(bytes(PAINT) + b"\x33", 8, 6)))
variant("BLEND: clear", twin=no_box, wrong=plain)(alpha("BLEND", 0))
variant("BLEND: opaque", wrong=no_box)(alpha("BLEND", 1))
variant("OPAQUE: alpha does not count", wrong=no_box)(alpha("OPAQUE", 0.1))


@variant("double-sided", wrong=reversed_box)
def _():
    gltf = reversed_box()
    gltf.paint["doubleSided"] = True
    return gltf


def with_extension(name, value, required=False):
    def make():
        gltf = plain()
        gltf.extension(name, gltf.paint, value, required)
        return gltf
    return make


SHINY = {"KHR_materials_ior": {"ior": 2.4}, "KHR_materials_sheen": {"sheenColorFactor": [0.9, 0.9, 0.9]},
         "KHR_materials_clearcoat": {"clearcoatFactor": 1}, "KHR_materials_iridescence": {"iridescenceFactor": 1},
         "KHR_materials_specular": {"specularFactor": 0.2}, "KHR_materials_anisotropy": {"anisotropyStrength": 0.7},
         "KHR_materials_dispersion": {"dispersion": 0.4}}
for extension_name, extension_value in SHINY.items():
    variant(extension_name, told=extension_name)(with_extension(extension_name, extension_value))
    variant(f"{extension_name}, required", told=extension_name)(with_extension(extension_name, extension_value, True))

GLASS = {"KHR_materials_transmission": {"transmissionFactor": 0.9},
         "KHR_materials_volume": {"thicknessFactor": 0.5, "attenuationColor": [1, 0, 0], "attenuationDistance": 0.1},
         "KHR_materials_diffuse_transmission": {"diffuseTransmissionFactor": 0.8}}
for extension_name, extension_value in GLASS.items():
    variant(extension_name, told=extension_name, or_read=True)(with_extension(extension_name, extension_value))


@variant("specular-glossiness", told="KHR_materials_pbrSpecularGlossiness", or_read=True)
def _():
    gltf = plain()
    del gltf.paint["pbrMetallicRoughness"]
    gltf.extension("KHR_materials_pbrSpecularGlossiness", gltf.paint, {
        "diffuseFactor": [*linear(PAINT), 1], "specularFactor": [0.04] * 3, "glossinessFactor": 0})
    return gltf


@variant("variants of materials", told="KHR_materials_variants")
def _():
    gltf = plain()
    gltf.json["extensions"]["KHR_materials_variants"] = {"variants": [{"name": "plain"}, {"name": "white"}]}
    gltf.extension("KHR_materials_variants", gltf.box, {"mappings": [{"material": 0, "variants": [1]}]})
    return gltf


def with_texture_of(slot, texture, **use):
    def make():
        gltf = glowing([1, 1, 1])() if slot == "emissiveTexture" else plain()
        info = {"index": gltf.texture(texture), **use}
        if slot == "metallicRoughnessTexture":
            gltf.paint["pbrMetallicRoughness"].update(metallicFactor=1, roughnessFactor=1,
                                                      metallicRoughnessTexture=info)
        else:
            gltf.paint[slot] = info
        return gltf
    return make


@variant("emissive texture of the second set of coordinates", twin=glowing(linear(PAINT)),
         wrong=glowing(linear(OTHER)), tolerance=2e-3)
def _():
    gltf = with_texture_of("emissiveTexture", half_png(), texCoord=1)()
    set_uvs(gltf, RIGHT)
    set_uvs(gltf, LEFT, "TEXCOORD_1")
    return gltf


@variant("emissive texture with a transform", twin=glowing(linear(PAINT)), wrong=glowing(linear(OTHER)),
         tolerance=2e-3)
def _():
    gltf = with_texture_of("emissiveTexture", half_png())()
    set_uvs(gltf, RIGHT)
    gltf.extension("KHR_texture_transform", gltf.paint["emissiveTexture"], {"offset": [-0.5, 0]})
    return gltf


@variant("metallic-roughness texture with a transform", twin=metal, wrong=plain, tolerance=2e-3)
def _():
    gltf = with_texture_of("metallicRoughnessTexture", half_png((0, 51, 255), (0, 255, 0)))()
    set_uvs(gltf, RIGHT)
    info = gltf.paint["pbrMetallicRoughness"]["metallicRoughnessTexture"]
    gltf.extension("KHR_texture_transform", info, {"offset": [-0.5, 0]})
    return gltf


@variant("an image for two uses", twin=lambda: two_uses_twin(), wrong=plain, tolerance=2e-3)
def _():  # sRGB for the base colour, linear for metallic-roughness
    gltf = textured(flat_png())
    info = gltf.paint["pbrMetallicRoughness"]["baseColorTexture"]
    gltf.paint["pbrMetallicRoughness"].update(metallicFactor=1, roughnessFactor=1, metallicRoughnessTexture=dict(info))
    return gltf


def two_uses_twin():
    gltf = plain()
    gltf.paint["pbrMetallicRoughness"].update(roughnessFactor=PAINT[1] / 255, metallicFactor=PAINT[2] / 255)
    return gltf


@variant("a texture without coordinates", told="TEXCOORD_0")
def _():
    gltf = textured(half_png())
    del gltf.box["attributes"]["TEXCOORD_0"]
    return gltf


@variant("a texture without its second set of coordinates", told="TEXCOORD_1")
def _():
    return textured(half_png(), LEFT, texCoord=1)


@variant("a texture without an image", told="texture 0")
def _():
    gltf = textured(half_png())
    del gltf.json["textures"][0]["source"]
    return gltf


@variant("an unread texture of Basis Universal", wrong=no_box)
def _():
    gltf = basisu(False)
    info = gltf.paint["pbrMetallicRoughness"].pop("baseColorTexture")
    gltf.paint["pbrMetallicRoughness"]["baseColorFactor"] = [*linear(PAINT), 1]
    gltf.paint["normalTexture"] = info
    return gltf


@variant("vertex colours of an unlit material", twin=lambda: unlit_twin(), wrong=lambda: unlit_white(), tolerance=1e-3)
def _():
    gltf = unlit_white()
    gltf.box["attributes"]["COLOR_0"] = gltf.accessor([linear(PAINT)] * 24)
    return gltf


def unlit_white():
    gltf = plain(color=[1, 1, 1])
    gltf.extension("KHR_materials_unlit", gltf.paint)
    return gltf


variant("BLEND: alpha of vertices", twin=no_box, wrong=plain)(alpha("BLEND", 1, vertex=0))
variant("BLEND: alpha of a texture", twin=no_box, wrong=plain)(
    alpha("BLEND", 1, image=flat_png(bytes(PAINT) + b"\0", 8, 6)))
variant("an unknown alpha mode", refused="alphaMode")(alpha("DITHER", 0.5))


@variant("coordinates in texels, by KHR_mesh_quantization", wrong=painted(OTHER))
def _():
    gltf = texture_transform((2, 2, 2, 2), scale=[1 / 8, 1 / 8])
    view = gltf.view(bytes((2, 2, 0, 0)) * 24, byteStride=4)
    gltf.box["attributes"]["TEXCOORD_0"] = gltf.accessor([[2, 2]] * 24, UBYTE, view=view)
    gltf.extension("KHR_mesh_quantization", required=True)
    return gltf


@variant("an emissive strength below zero", refused="negative")
def _():
    gltf = glowing([1, 1, 1])()
    gltf.extension("KHR_materials_emissive_strength", gltf.paint, {"emissiveStrength": -1})
    return gltf


@variant("a bumpy normal map", told="normal")
def _():
    gltf = plain()
    gltf.paint["normalTexture"] = {"index": gltf.texture(half_png((250, 128, 170), (6, 128, 170)))}
    return gltf


variant("OPAQUE: alpha of vertices does not count", wrong=no_box)(alpha("OPAQUE", 1, vertex=0))


@variant("colours of an accessor without bytes, which are black", twin=lambda: plain(color=[0, 0, 0]), wrong=plain)
def _():
    gltf = plain()
    gltf.box["attributes"]["COLOR_0"] = gltf.add("accessors", {"componentType": FLOAT, "count": 24, "type": "VEC3"})
    return gltf


@variant("double-sided and mirrored", wrong=reversed_box)
def _():
    gltf = plain(positions=[[-x, y, z] for x, y, z in box_mesh()[0]])
    gltf.node("box")["scale"] = [-1, 1, 1]
    gltf.paint["doubleSided"] = True
    return gltf


@variant("unlit: cut away", twin=no_box, wrong=plain)
def _():
    gltf = alpha("MASK", 0.3)()
    gltf.extension("KHR_materials_unlit", gltf.paint)
    return gltf
