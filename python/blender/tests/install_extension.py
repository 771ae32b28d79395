# SPDX-License-Identifier: MIT
"""install_extension.py ZIP: installs it as Blender 4.2 and newer do and renders 16 x 16 pixels.

To be run with bpy; BLENDER_USER_RESOURCES says where it goes.
"""

import sys

import bpy

bpy.ops.wm.read_factory_settings()
bpy.ops.extensions.package_install_files(
    filepath=sys.argv[1], repo="user_default", enable_on_install=True
)
scene = bpy.context.scene
scene.render.engine = "MIR"
scene.render.resolution_x = scene.render.resolution_y = 16
bpy.ops.render.render()
import mir  # noqa: E402

print(f"extension: {mir.__file__}: 0 failures")
