# SPDX-License-Identifier: MIT
"""mir.mpi by three ranks of mpi4py, PyPI's or Debian's."""

import importlib.util
import os
import pathlib
import shutil
import subprocess
import sys
import sysconfig

import pytest

DEBIAN = pathlib.Path("/usr/lib/python3/dist-packages/mpi4py")
RANKS = pathlib.Path(__file__).with_name("mpi_ranks.py")
# More ranks than cores, by whoever runs the tests, in a container or not.
ANYWHERE = {
    "OMPI_ALLOW_RUN_AS_ROOT": "1",
    "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
    "OMPI_MCA_rmaps_base_oversubscribe": "1",
    "OMPI_MCA_hwloc_base_binding_policy": "none",
    "OMPI_MCA_btl_vader_single_copy_mechanism": "none",
}


@pytest.fixture
def environment(tmp_path):
    """In which ranks find mpi4py, alone of what else Debian has for Python."""
    suffix = sysconfig.get_config_var("EXT_SUFFIX")
    folder = tmp_path / "packages"
    folder.mkdir()
    if not importlib.util.find_spec("mpi4py"):
        if not (DEBIAN / f"MPI{suffix}").exists():
            pytest.skip("mpi4py is not installed for this Python (Debian: python3-mpi4py)")
        (folder / "mpi4py").symlink_to(DEBIAN)
    if not shutil.which("mpirun"):
        pytest.skip("mpirun is not installed (Debian: openmpi-bin)")
    found = {**os.environ, **ANYWHERE, "PYTHONPATH": str(folder)}
    tried = ranks(["-c", "from mpi4py import MPI"], found, tmp_path)
    if tried.returncode != 0:
        pytest.skip(f"ranks cannot be started here ({(tried.stderr.split(chr(10)) + [''])[0]})")
    return found


def ranks(words, environment, folder):
    return subprocess.run(
        ["mpirun", "-n", "3", sys.executable, *words],
        env=environment,
        cwd=folder,
        capture_output=True,
        text=True,
        timeout=300,
    )


def test_ranks_make_the_bytes_of_one_process_or_all_raise(environment, tmp_path):
    ran = ranks([RANKS], environment, tmp_path)
    assert ran.returncode == 0, ran.stderr
    assert ran.stdout.count("done") == 3
    assert (tmp_path / "ranks.exr").read_bytes() == (tmp_path / "one.exr").read_bytes()


def test_importing_mir_brings_no_mpi():
    code = "import sys, mir, mir.team; print({'mpi4py', 'mir.mpi'} & sys.modules.keys())"
    ran = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert ran.stdout.strip() == "set()"


def test_the_module_links_no_mpi():
    import mir

    read = subprocess.run(
        ["ldd", mir._core.__file__], capture_output=True, text=True, check=True
    )
    assert "libmpi" not in read.stdout
