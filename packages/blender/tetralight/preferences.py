# SPDX-License-Identifier: Apache-2.0
"""Preferences of the add-on: what bakes, and where. Blender saves them with its own, never in a .blend file."""
import os

import bpy
from bpy.props import EnumProperty, StringProperty

from .baking import CommandBake, ServiceBake
from .service import Service

TOKEN_VARIABLE = "TETRALIGHT_TOKEN"


class TetralightPreferences(bpy.types.AddonPreferences):
    bl_idname = __package__

    bake_with: EnumProperty(
        name="Bake With",
        items=[
            ("COMMAND", "Command", "The program tetralight on this machine"),
            ("SERVICE", "Service", "A server that runs `tetralight serve`"),
        ],
    )
    command: StringProperty(
        name="Command", description="Path of the program tetralight, or its name if it is on PATH", subtype="FILE_PATH",
        default="tetralight")
    address: StringProperty(
        name="Address", description="Address of the service, such as http://127.0.0.1:8080",
        default="http://127.0.0.1:8080")
    token: StringProperty(
        name="Token", subtype="PASSWORD",
        description=f"Token of the service. Empty: the environment variable {TOKEN_VARIABLE}, if it is set")

    def draw(self, context):
        layout = self.layout
        layout.use_property_split = True
        layout.prop(self, "bake_with", expand=True)
        if self.bake_with == "COMMAND":
            layout.prop(self, "command")
            return
        layout.prop(self, "address")
        layout.prop(self, "token")
        layout.label(text="Blender saves the token unencrypted with its preferences, and not in .blend files.")


def preferences(context):
    return context.preferences.addons[__package__].preferences


def new_bake(context, settings):
    """A bake by the command or the service that the preferences name. Raises ServiceError if they cannot be used."""
    chosen = preferences(context)
    if chosen.bake_with == "COMMAND":
        return CommandBake(bpy.path.abspath(chosen.command), settings)
    token = chosen.token.strip() or os.environ.get(TOKEN_VARIABLE, "").strip()
    return ServiceBake(Service(chosen.address, token), settings)


def register():
    bpy.utils.register_class(TetralightPreferences)


def unregister():
    bpy.utils.unregister_class(TetralightPreferences)
