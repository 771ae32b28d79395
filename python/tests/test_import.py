# SPDX-License-Identifier: MIT
"""What importing costs and shows."""

import pathlib
import subprocess
import sys

import mir


def run(code):
    return subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)


def test_import_takes_below_0_3_s():
    # Seconds of the processor: others may keep it busy meanwhile.
    code = "import time; t = time.process_time(); import mir; print(time.process_time() - t)"
    assert min(float(run(code).stdout) for _ in range(5)) < 0.3


def test_import_loads_no_package_of_others():
    code = "import sys, mir; print([m for m in ('numpy', 'tqdm', 'pxr') if m in sys.modules])"
    assert run(code).stdout.strip() == "[]"


def test_only_the_entry_of_the_module_is_seen_from_outside():
    core = pathlib.Path(mir._core.__file__)
    symbols = subprocess.run(
        ["nm", "-D", "--defined-only", core], capture_output=True, text=True, check=True
    ).stdout.split()[2::3]
    assert symbols == ["PyInit__core"]


def test_every_public_name_has_words():
    for name in mir.__all__:
        assert getattr(mir, name).__doc__, name


def test_stubs_lie_beside_the_module():
    folder = pathlib.Path(mir.__file__).parent
    assert (folder / "py.typed").exists()
    assert "class Scene" in (folder / "_core.pyi").read_text()
