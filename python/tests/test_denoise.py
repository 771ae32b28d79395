# SPDX-License-Identifier: MIT
"""Pictures without noise, where Open Image Denoise is installed."""

import numpy as np
import pytest

import mir
from mir import _denoiser


def test_a_library_that_is_missing_is_an_error_with_a_remedy(small):
    result = mir.render("builtin:cornell-box", **small)
    with pytest.raises(mir.Error, match="MIR_OIDN_LIBRARY") as caught:
        result.denoised("/nowhere/libOpenImageDenoise.so")
    assert caught.value.code == "no_device"


def test_the_environment_comes_before_packages(monkeypatch):
    monkeypatch.setenv("MIR_OIDN_LIBRARY", "/nowhere/libOpenImageDenoise.so")
    assert _denoiser.find_library() == ""


@pytest.mark.extended
def test_a_denoised_picture_is_nearer_to_its_reference(tmp_path):
    pytest.importorskip("pyoidn", reason="pyoidn is not installed")
    size = dict(width=96, height=72, filter="box")
    reference = mir.reference("builtin:cornell-box", samples=256, **size)
    noisy = mir.reference("builtin:cornell-box", samples=1, **size)
    before = noisy.beauty.copy()
    clean = noisy.denoised()
    assert clean.shape == (72, 96, 3) and clean.dtype == np.float32
    assert mir.compare(clean, reference).rmse < 0.5 * mir.compare(noisy, reference).rmse
    assert (noisy.beauty == before).all()
    assert not any("pixel filter" in warning for warning in noisy.warnings)
    noisy.save(tmp_path / "a.exr")
    assert (noisy.denoised() == clean).all()
