# SPDX-License-Identifier: MIT
"""The wheel that brings its own libraries, beside a host that has others of these."""

import json
import pathlib
import subprocess

import pytest

from conftest import ROOT

pytestmark = pytest.mark.extended

PYTHON = ROOT / "build/venv-whole/bin/python"
BIGGEST = 25e6  # bytes

LOOK = """
import ctypes, json
import mir

def picture():
    result = mir.render("builtin:sphere", width=32, height=24, vpls=32, accel="embree")
    return float(result.beauty.sum())

def is_global(name):
    return hasattr(ctypes.CDLL(None), name)

def libraries():
    lines = open("/proc/self/maps").read().splitlines()
    return sorted({line.split()[-1] for line in lines if ".so" in line})

def tell(**facts):
    print(json.dumps({"libraries": libraries(), **facts}))
"""

HOST = """
import ctypes

def load(name):
    try:
        return ctypes.CDLL(name, ctypes.RTLD_GLOBAL)
    except OSError:
        return None

embree = load("libembree4.so.4") or load("libembree3.so.3")
tbb = load("libtbb.so.12")
embree.rtcNewDevice.restype = ctypes.c_void_p
embree.rtcReleaseDevice.argtypes = [ctypes.c_void_p]

def trace():
    device = embree.rtcNewDevice(b"threads=1")
    embree.rtcReleaseDevice(device)
    return bool(device)
"""


def run(code):
    if not PYTHON.exists():
        pytest.skip("python/wheel.sh was not run")
    done = subprocess.run([PYTHON, "-I", "-c", code], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


def names_of(paths, word):
    return [pathlib.Path(p).name for p in paths if word in pathlib.Path(p).name]


def test_its_libraries_have_names_of_their_own():
    seen = run(LOOK + "tell(light=picture())")
    assert seen["light"] > 0
    for word in ("embree", "libtbb", "OpenEXR", "tinygltf"):
        found = [p for p in seen["libraries"] if word in pathlib.Path(p).name]
        own = [p for p in found if "/mir.libs/" in p and "-" in pathlib.Path(p).name]
        # oneTBB itself looks for its allocator on the machine.
        assert own and not [p for p in found if p not in own and "tbbmalloc" not in p], found


def test_no_symbol_of_embree_or_tbb_is_global():
    names = ["rtcNewDevice", "mir_own_rtcNewDevice", "TBB_runtime_version", "PyInit__core"]
    seen = run(LOOK + f"picture(); tell(found=[n for n in {names} if is_global(n)])")
    assert seen["found"] == []


def test_none_of_its_libraries_has_their_usual_symbols():
    libraries = [p for p in run(LOOK + "tell()")["libraries"] if "/mir" in p]
    assert libraries
    for library in libraries:
        symbols = subprocess.run(
            ["nm", "-D", library], capture_output=True, text=True, check=True
        ).stdout.split("\n")
        usual = [s.split()[-1] for s in symbols if s]
        assert not [n for n in usual if n.startswith(("rtc", "TBB_", "_ZN3tbb"))], library


def test_a_host_with_its_own_libraries_is_not_disturbed():
    seen = run(
        HOST
        + "before = trace()"
        + LOOK
        + "tell(light=picture(), again=picture(), before=before, after=trace())"
    )
    alone = run(LOOK + "tell(light=picture())")
    assert seen["before"] and seen["after"]
    assert seen["light"] == seen["again"] == alone["light"]
    assert len(names_of(seen["libraries"], "embree")) == 2
    assert len(names_of(seen["libraries"], "libtbb.") + names_of(seen["libraries"], "libtbb-")) == 2


def test_it_is_small():
    (wheel,) = (ROOT / "build/dist/whole").glob("mir-*.whl")
    assert "manylinux" in wheel.name and wheel.stat().st_size < BIGGEST
