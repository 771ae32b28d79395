# SPDX-License-Identifier: MIT
"""The code of the page, the examples and the notebook run."""

import os
import pathlib
import re
import subprocess
import sys

import numpy as np
import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]
EXAMPLES = sorted((ROOT / "python/examples").glob("*.py"))


def blocks(page):
    """Blocks of Python, but those that are marked as not run."""
    found = re.findall(r"(<!--[^\n]*-->\n)?```python\n(.*?)```", page, re.DOTALL)
    return [code for mark, code in found if "not run" not in mark]


def test_the_code_of_the_page_runs(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    code = blocks((ROOT / "docs/python.md").read_text())
    assert len(code) >= 7
    exec(compile("\n".join(code), "docs/python.md", "exec"), {})
    assert (tmp_path / "box.exr").exists()


@pytest.mark.parametrize("script", EXAMPLES, ids=lambda path: path.stem)
def test_examples_run(script, tmp_path):
    ran = subprocess.run(
        [sys.executable, script, "--small"], cwd=tmp_path, capture_output=True, text=True
    )
    assert ran.returncode == 0, ran.stderr
    assert ran.stdout


def test_the_notebook_runs(tmp_path):
    nbclient = pytest.importorskip("nbclient")
    nbformat = pytest.importorskip("nbformat")
    notebook = nbformat.read(ROOT / "python/examples/first_steps.ipynb", as_version=4)
    os.environ.setdefault("IPYTHONDIR", str(tmp_path))
    nbclient.NotebookClient(notebook, timeout=120, kernel_name="python3").execute(cwd=tmp_path)
    outputs = [o for cell in notebook.cells for o in cell.get("outputs", [])]
    assert any("image/png" in o.get("data", {}) for o in outputs)


def test_pairs_of_the_denoiser_example(tmp_path):
    script = ROOT / "python/examples/denoiser_pairs.py"
    subprocess.run([sys.executable, script, "--small"], cwd=tmp_path, check=True)
    files = sorted(tmp_path.glob("pairs/*.npz"))
    assert files
    pair = np.load(files[0])
    assert pair["noisy"].shape == pair["clean"].shape
    assert not np.array_equal(pair["noisy"], pair["clean"])
