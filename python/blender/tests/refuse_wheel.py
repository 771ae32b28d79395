# SPDX-License-Identifier: MIT
"""A wheel that does not fit is refused with a sentence. Needs no Blender: the add-on says so first.

The add-on is the unpacked zip in MIR_CHECK_ADDON; here its wheel has a module of another Python, or
asks for a numpy that is not there.
"""

import importlib
import os
import shutil
import sys
import tempfile
from pathlib import Path


def _refusal(package: str) -> str:
    """What register() says with this text in mir/__init__.py."""
    with tempfile.TemporaryDirectory() as folder:
        addon = Path(folder, "mir_render")
        original = Path(os.environ["MIR_CHECK_ADDON"], "mir_render")
        shutil.copytree(original, addon, ignore=shutil.ignore_patterns("unpacked_wheel"))
        wheel = addon / "unpacked_wheel" / "mir"
        wheel.mkdir(parents=True)
        (wheel / "__init__.py").write_text(package, encoding="ascii")
        (wheel / "_core.cpython-39-x86_64-linux-gnu.so").touch()
        sys.path.insert(0, folder)
        try:
            importlib.import_module("mir_render").register()
        except ImportError as error:
            return str(error)
        finally:
            sys.path[:] = [one for one in sys.path if not one.startswith(folder)]
            for name in [one for one in sys.modules if one.split(".")[0] in ("mir", "mir_render")]:
                del sys.modules[name]
    return "nothing"


failures = 0
for package, wanted in (
    ("import mir._core", "its wheel is for Python 3.11"),
    ("raise ModuleNotFoundError('none', name='numpy')", "install python3-numpy"),
):
    said = _refusal(package)
    if wanted not in said:
        print(f"FAILED: the add-on says '{said}'")
        failures += 1
print(f"refused wheels: {failures} failures")
sys.exit(failures)
