# SPDX-License-Identifier: MIT
"""What cannot be used is answered by one mir.Error with code and place."""

import ctypes
import subprocess

import numpy as np
import pytest

import mir


def error_of(call):
    with pytest.raises(mir.Error) as raised:
        call()
    return raised.value


TRIANGLE = np.eye(3, dtype=np.float32)
FACE = np.array([[0, 1, 2]], np.uint32)


@pytest.mark.parametrize(
    ("settings", "place"),
    [
        ({"vpls": 0}, "vpls"),
        ({"vpls": "many"}, "vpls"),
        ({"sampler": "none"}, "sampler"),
        ({"direct_samples": -1}, "direct_samples"),
        ({"bound": "loose"}, "bound"),
        ({"tile": (0, 3)}, "tile"),
        ({"vpl": 3}, "vpl"),
        ({"output": "a.exr"}, "output"),
        ({"vsl": "maybe"}, "vsl"),
        ({"eye": (0, 0)}, "eye"),
        ({"seed": object()}, "seed"),
    ],
)
def test_settings_that_cannot_be_used(settings, place):
    error = error_of(lambda: mir.render("builtin:sphere", **settings))
    assert (error.code, error.place) == ("invalid_argument", place)


def test_words_are_those_of_the_program(program):
    ran = subprocess.run(
        [program, "render", "builtin:sphere", "--vpls=0"], capture_output=True, text=True
    )
    error = error_of(lambda: mir.render("builtin:sphere", vpls=0))
    assert ran.stderr.startswith(f"mir: {error}\n")


def test_mistyped_settings_are_guessed():
    assert "did you mean --vpls?" in str(error_of(lambda: mir.render("builtin:sphere", vpl=3)))


def test_scenes_that_are_not_there():
    assert error_of(lambda: mir.load("builtin:nothing")).code == "invalid_input"
    assert error_of(lambda: mir.load("/nowhere.glb")).code == "invalid_input"
    assert error_of(lambda: mir.render(3)).place == "scene"


def test_scenes_that_cannot_be_rendered():
    assert error_of(lambda: mir.render(mir.Scene())).code == "invalid_input"


NAN = np.where(np.eye(3) > 0, np.nan, 0)


@pytest.mark.parametrize(
    ("vertices", "indices", "place"),
    [
        (TRIANGLE.astype(np.int32), FACE, "vertices"),
        (TRIANGLE.astype(np.float16), FACE, "vertices"),
        (TRIANGLE.astype(complex), FACE, "vertices"),
        (TRIANGLE[:, :2], FACE, "vertices"),
        (TRIANGLE.ravel(), FACE, "vertices"),
        (NAN, FACE, "vertices"),
        (TRIANGLE * np.float64(1e300), FACE, "vertices"),
        ("text", FACE, "vertices"),
        (None, FACE, "vertices"),
        ([[1, 2], [3]], FACE, "vertices"),
        (TRIANGLE, FACE.astype(np.float32), "indices"),
        (TRIANGLE, FACE + 1, "indices"),
        (TRIANGLE, FACE.astype(np.int64) - 1, "indices"),
        (TRIANGLE, FACE[:, :2], "indices"),
        (TRIANGLE, np.array([[0, 1, 2**40]]), "indices"),
    ],
)
def test_meshes_that_cannot_be_used(vertices, indices, place):
    scene = mir.Scene()
    scene.add_material()
    error = error_of(lambda: scene.add_mesh(vertices, indices))
    assert (error.code, error.place) == ("invalid_argument", place)
    assert scene.meshes == 0


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("normals", TRIANGLE[:2]),
        ("normals", np.zeros((3, 3))),
        ("uv", TRIANGLE),
        ("colors", TRIANGLE * 2),
        ("transform", np.eye(3)),
        ("transform", np.ones((4, 4))),
        ("material", 7),
    ],
)
def test_attributes_that_cannot_be_used(name, value):
    scene = mir.Scene()
    scene.add_material()
    error = error_of(lambda: scene.add_mesh(TRIANGLE, FACE, **{name: value}))
    assert (error.code, error.place) == ("invalid_argument", name)


def test_materials_lights_and_cameras_that_cannot_be_used():
    scene = mir.Scene()
    assert error_of(lambda: scene.add_material(metallic=2)).place == "metallic"
    assert error_of(lambda: scene.add_material(base_color=(1, 2, 3))).place == "base_color"
    assert error_of(lambda: scene.add_material(emission=(1, -1, 0))).place == "emission"
    assert error_of(lambda: scene.add_material(normal_image=0)).place == "normal_image"
    assert error_of(lambda: scene.add_point_light((0, 0), (1, 1, 1))).place == "position"
    assert error_of(lambda: scene.add_point_light((0, 0, np.nan), (1, 1, 1))).place == "position"
    dark = (0, 0, 0)
    assert error_of(lambda: scene.add_directional_light(dark, dark)).place == "direction"
    assert error_of(lambda: scene.set_environment(-np.ones((1, 2, 3)))).place == "radiance"
    assert error_of(lambda: scene.add_camera(dark, dark)).place == "target"
    assert error_of(lambda: scene.add_camera(dark, (0, 1, 0))).place == "up"
    image = np.zeros((2, 2, 3), np.float32)
    assert error_of(lambda: scene.add_image(image)).place == "pixels"


def test_arrays_may_be_read_only_strided_or_lists():
    scene = mir.Scene()
    scene.add_material()
    locked = TRIANGLE.copy()
    locked.flags.writeable = False
    wide = np.zeros((6, 6), np.float32)
    wide[::2, ::2] = TRIANGLE
    for vertices in (locked, wide[::2, ::2], TRIANGLE[::-1], TRIANGLE.T, TRIANGLE.tolist()):
        scene.add_mesh(vertices, FACE.astype(np.int64)[::-1])
    assert scene.triangles == 5


class _DlTensor(ctypes.Structure):
    _fields_ = [
        ("data", ctypes.c_void_p),
        ("device_type", ctypes.c_int32),
        ("device_id", ctypes.c_int32),
        ("ndim", ctypes.c_int32),
        ("code", ctypes.c_uint8),
        ("bits", ctypes.c_uint8),
        ("lanes", ctypes.c_uint16),
        ("shape", ctypes.POINTER(ctypes.c_int64)),
        ("strides", ctypes.POINTER(ctypes.c_int64)),
        ("byte_offset", ctypes.c_uint64),
        ("manager", ctypes.c_void_p),
        ("deleter", ctypes.c_void_p),
    ]


class GpuArray:
    """(3, 3) floats that DLPack says lie on a GPU."""

    def __init__(self):
        self.shape = (ctypes.c_int64 * 2)(3, 3)
        self.tensor = _DlTensor(8, 2, 0, 2, 2, 32, 1, self.shape, None, 0, None, None)

    def __dlpack_device__(self):
        return (2, 0)

    def __dlpack__(self, **_):
        make = ctypes.pythonapi.PyCapsule_New
        make.restype = ctypes.py_object
        make.argtypes = [ctypes.c_void_p, ctypes.c_char_p, ctypes.c_void_p]
        return make(ctypes.addressof(self.tensor), b"dltensor", None)


def test_arrays_on_another_device():
    scene = mir.Scene()
    scene.add_material()
    error = error_of(lambda: scene.add_mesh(GpuArray(), FACE))
    assert (error.code, error.place) == ("invalid_argument", "vertices")
    assert "another device" in str(error)


def test_a_scene_is_not_edited_while_it_renders(room, small):
    found = []

    def edit(progress):
        if not found:
            found.append(error_of(lambda: room.add_material()))

    mir.render(room, progress=edit, **small)
    assert found[0].code == "invalid_argument"
    room.add_material()
    passes = mir.progressive(room, **small)
    next(passes)
    assert error_of(lambda: room.add_material()).code == "invalid_argument"
    passes.close()
    room.add_material()
