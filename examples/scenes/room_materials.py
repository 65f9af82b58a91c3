# SPDX-License-Identifier: Apache-2.0
"""The materials of make_room.py."""

LAMP_COLOR = [1.0, 0.74, 0.48]

MATERIALS = {  # name: (linear base colour, roughness, what else the material has)
    "plaster": ((0.70, 0.67, 0.61), 0.9, {"normal": ("plaster_normal", 0.5)}),
    "plaster_sage": ((0.30, 0.36, 0.30), 0.9, {"normal": ("plaster_normal", 0.5)}),
    "plaster_corridor": ((0.62, 0.57, 0.50), 0.9, {"normal": ("plaster_normal", 0.5)}),
    "facade": ((0.52, 0.44, 0.35), 0.9, {}),
    "ceiling": ((0.80, 0.79, 0.76), 0.9, {}),
    "paint_white": ((0.76, 0.75, 0.71), 0.35, {}),
    "floor": ((1, 1, 1), 0.42, {"color": "floor", "normal": ("floor_normal", 0.6)}),
    "rug": ((1, 1, 1), 1.0, {"color": "rug"}),
    "fabric": ((0.40, 0.13, 0.065), 0.95, {"normal": ("weave_normal", 0.6)}),
    "fabric_cream": ((0.66, 0.58, 0.45), 0.95, {"normal": ("weave_normal", 0.6)}),
    "fabric_green": ((0.13, 0.20, 0.13), 0.95, {"normal": ("weave_normal", 0.6)}),
    "linen": ((0.66, 0.61, 0.52), 0.95, {"doubleSided": True}),
    "wood_dark": ((0.11, 0.06, 0.035), 0.4, {"color": "wood"}),
    "wood_walnut": ((0.20, 0.12, 0.07), 0.35, {"color": "wood"}),
    "wood_ash": ((0.62, 0.44, 0.27), 0.4, {"color": "wood"}),
    "wood_figure": ((0.74, 0.55, 0.36), 0.45, {"color": "wood"}),
    "lacquer": ((0.16, 0.075, 0.04), 0.12, {"color": "wood"}),
    "brass": ((0.83, 0.62, 0.30), 0.25, {"metallic": 1.0}),
    "copper": ((0.85, 0.50, 0.36), 0.22, {"metallic": 1.0}),
    "chrome": ((0.72, 0.73, 0.74), 0.05, {"metallic": 1.0}),
    "mirror": ((0.85, 0.86, 0.86), 0.0, {"metallic": 1.0}),
    "shade": ((0.75, 0.68, 0.56), 0.9, {"emission": 2.2, "doubleSided": True}),
    "shade_inside": ((0.80, 0.78, 0.74), 0.6, {}),
    "bulb_pendant": ((0.8, 0.8, 0.8), 0.5, {"emission": 14.0}),
    "terracotta": ((0.45, 0.19, 0.10), 0.85, {}),
    "leaf": ((0.10, 0.22, 0.05), 0.45, {"doubleSided": True}),
    "ceramic": ((0.80, 0.78, 0.73), 0.12, {}),
    "ball": ((0.78, 0.78, 0.76), 0.5, {}),
    "canvas": ((0.78, 0.75, 0.68), 0.9, {}),
    "picture_hills": ((1, 1, 1), 0.6, {"color": "picture_hills"}),
    "picture_discs": ((1, 1, 1), 0.6, {"color": "picture_discs"}),
    "picture_corridor": ((1, 1, 1), 0.6, {"color": "picture_hills"}),
    "book_red": ((0.34, 0.06, 0.05), 0.6, {}),
    "book_blue": ((0.06, 0.11, 0.24), 0.6, {}),
    "book_cream": ((0.66, 0.59, 0.46), 0.7, {}),
    "book_green": ((0.07, 0.17, 0.11), 0.6, {}),
    "book_ochre": ((0.55, 0.31, 0.07), 0.6, {}),
    "book_black": ((0.04, 0.04, 0.045), 0.5, {}),
    "lawn": ((0.42, 0.55, 0.18), 1.0, {"color": "leaves"}),
    "hedge": ((0.30, 0.42, 0.13), 1.0, {"color": "leaves"}),
}


def material_json(name, color, roughness, look, images):
    surface = {"baseColorFactor": [*color, 1], "metallicFactor": look.get("metallic", 0.0),
               "roughnessFactor": roughness}
    material = {"name": name, "pbrMetallicRoughness": surface}
    if "color" in look:
        surface["baseColorTexture"] = {"index": images.index(look["color"])}
    if "normal" in look:
        material["normalTexture"] = {"index": images.index(look["normal"][0]), "scale": look["normal"][1]}
    if "emission" in look:
        material["emissiveFactor"] = LAMP_COLOR
        material["extensions"] = {"KHR_materials_emissive_strength": {"emissiveStrength": look["emission"]}}
    if "doubleSided" in look:
        material["doubleSided"] = True
    return material
