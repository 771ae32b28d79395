# SPDX-License-Identifier: MIT
"""Arrays of a GPU, of every library that is there: read where they lie, and answered there."""

import importlib
import os

import numpy as np
import pytest

import mir

pytestmark = pytest.mark.gpu

SIZE = {"width": 96, "height": 64, "vpls": 128}


def has_gpu():
    """True where the module was built with CUDA and finds a GPU."""
    return any(name.startswith("cuda") for name, _ in mir.devices())


class Torch:
    def __init__(self):
        self.lib = importlib.import_module("torch")

    def there(self, array):
        return self.lib.from_numpy(np.ascontiguousarray(array)).cuda()

    def taken(self, capsule):
        return self.lib.from_dlpack(capsule)

    def home(self, array):
        return array.cpu().numpy()

    def address(self, array):
        return array.data_ptr()


class Cupy(Torch):
    def __init__(self):
        self.lib = importlib.import_module("cupy")

    def there(self, array):
        return self.lib.asarray(array)

    def home(self, array):
        return self.lib.asnumpy(array)

    def address(self, array):
        return array.data.ptr


class Jax(Torch):
    def __init__(self):
        os.environ.setdefault("XLA_PYTHON_CLIENT_PREALLOCATE", "false")  # leave memory to others
        self.lib = importlib.import_module("jax")

    def there(self, array):
        return self.lib.device_put(array)

    def taken(self, capsule):
        return importlib.import_module("jax.dlpack").from_dlpack(capsule)

    def home(self, array):
        return np.asarray(array)

    def address(self, array):
        return array.unsafe_buffer_pointer()


@pytest.fixture(params=[Torch, Cupy, Jax], ids=lambda kind: kind.__name__.lower())
def library(request):
    if not has_gpu():
        pytest.skip("the module was built without CUDA, or there is no GPU")
    try:
        return request.param()
    except ImportError as error:
        pytest.skip(str(error))


@pytest.fixture
def torch():
    if not has_gpu():
        pytest.skip("the module was built without CUDA, or there is no GPU")
    return pytest.importorskip("torch")


@pytest.fixture
def lit(room):
    """A scene, its G-buffer and its VPLs."""
    return room, mir.gbuffer(room, **SIZE), mir.sample_vpls(room, backend="cpu", **SIZE)


def all_there(library, gbuffer):
    return {name: library.there(array) for name, array in gbuffer.items()}


def segments(gbuffer, vpls):
    flat = [gbuffer[name].reshape(-1, 3) for name in ("position", "normal")]
    return [*flat, np.ascontiguousarray(vpls.positions), np.ascontiguousarray(vpls.normals)]


def same(ours, wanted):
    np.testing.assert_array_equal(ours, wanted)


def test_bits_are_those_of_the_processor(library, lit):
    scene, gbuffer, vpls = lit
    arrays = segments(gbuffer, vpls)
    for count in (4, 3):
        wanted = mir.visibility(scene, *arrays[:count])
        seen = mir.visibility(scene, *[library.there(a) for a in arrays[:count]])
        assert seen.__dlpack_device__() == (2, 0)
        same(library.home(library.taken(seen)), wanted)
    assert wanted.any()


def test_light_is_that_of_the_processor(library, lit):
    scene, gbuffer, vpls = lit
    there = all_there(library, gbuffer)
    wanted = mir.reconstruct(scene, gbuffer, vpls)
    assert wanted.max() > 0
    for lights in (vpls, vpls.on_gpu()):
        light = library.taken(mir.reconstruct(scene, there, lights))
        assert light.shape == (64, 96, 3)
        same(library.home(light), wanted)


def test_light_from_bits_is_that_of_the_processor(library, lit):
    scene, gbuffer, vpls = lit
    there = all_there(library, gbuffer)
    arrays = segments(gbuffer, vpls)
    offset = scene.ray_offset
    wanted = mir.reshade(gbuffer, vpls, mir.visibility(scene, *arrays), ray_offset=offset)
    bits = mir.visibility(scene, *[library.there(a) for a in arrays])
    light = mir.reshade(there, vpls.on_gpu(), bits, ray_offset=offset)
    same(library.home(library.taken(light)), wanted)


def test_results_are_not_copied(library, lit):
    scene, gbuffer, vpls = lit
    light = mir.reconstruct(scene, all_there(library, gbuffer), vpls)
    first, second = library.taken(light), library.taken(light)
    assert library.address(first) == library.address(second) != 0
    del light, second
    assert library.home(first).max() > 0  # the array keeps its memory


def test_vpls_there_are_not_copied(torch, lit):
    scene, gbuffer, vpls = lit
    there = all_there(Torch(), gbuffer)
    lights = vpls.on_gpu()
    once = torch.from_dlpack(mir.reconstruct(scene, there, lights)).cpu()
    torch.from_dlpack(lights["intensities"]).mul_(2)  # where mir reads them
    twice = torch.from_dlpack(mir.reconstruct(scene, there, lights)).cpu()
    torch.testing.assert_close(twice, 2 * once, rtol=1e-6, atol=0)


def test_arrays_are_read_where_they_lie(torch, lit):
    scene, gbuffer, vpls = lit
    there = all_there(Torch(), gbuffer)
    light = torch.from_dlpack(mir.reconstruct(scene, there, vpls))
    # The same arrays behind one address each, as columns of a larger one.
    wide = {n: torch.cat([a, a], dim=-1)[..., :3] for n, a in there.items() if a.ndim == 3}
    assert not wide["position"].is_contiguous()
    again = torch.from_dlpack(mir.reconstruct(scene, {**there, **wide}, vpls))
    assert torch.equal(light, again)


def test_streams_of_the_owner_are_waited_for(torch, lit):
    scene, gbuffer, vpls = lit
    there = all_there(Torch(), gbuffer)
    wanted = torch.from_dlpack(mir.reconstruct(scene, there, vpls)).clone()
    late = torch.zeros_like(there["position"])
    torch.cuda.synchronize()
    with torch.cuda.stream(torch.cuda.Stream()):
        torch.cuda._sleep(400_000_000)  # some tenths of a second
        late.copy_(there["position"])
        light = torch.from_dlpack(mir.reconstruct(scene, {**there, "position": late}, vpls))
        assert torch.equal(light, wanted)


def error_of(call):
    with pytest.raises(mir.Error) as raised:
        call()
    return raised.value.code, raised.value.place


def test_arrays_that_cannot_be_used(torch, lit):
    scene, gbuffer, vpls = lit
    there = all_there(Torch(), gbuffer)
    nan = there["albedo"].clone()
    nan[3, 4, 1] = float("nan")
    cases = {
        "gbuffer.normal": gbuffer["normal"],
        "gbuffer.albedo": nan,
        "gbuffer.view": there["view"].double(),
        "gbuffer.roughness": there["roughness"][1:],
    }
    for place, value in cases.items():
        changed = {**there, place.split(".")[1]: value}
        assert error_of(lambda: mir.reconstruct(scene, changed, vpls)) == (
            "invalid_argument",
            place,
        )
    bits = torch.zeros((64 * 96, 32), dtype=torch.uint8, device="cuda")[:, ::2]
    assert error_of(lambda: mir.reshade(there, vpls, bits)) == ("invalid_argument", "bits")
    assert error_of(lambda: mir.reconstruct(scene, gbuffer, vpls.on_gpu())) == (
        "invalid_argument",
        "vpls",
    )
    lonely = {"positions": there["position"].reshape(-1, 3)}
    assert error_of(lambda: mir.reconstruct(scene, there, lonely))[0] == "invalid_argument"
    grey = mir.Scene()
    grey.add_material()
    assert error_of(lambda: grey.add_mesh(there["position"][0], [[0, 1, 2]]))[1] == "vertices"


def test_no_memory_leaks(torch, lit):
    scene, gbuffer, vpls = lit
    there = all_there(Torch(), gbuffer)

    def free_after(rounds):
        for _ in range(rounds):
            torch.from_dlpack(mir.reconstruct(scene, there, vpls.on_gpu()))
        torch.cuda.synchronize()
        return torch.cuda.mem_get_info()[0]

    before = free_after(5)
    assert free_after(200) >= before - 2**20


def test_pictures_of_the_gpu(torch, room, small):
    wanted = mir.render(room, backend="cpu", **small)
    result = mir.render(room, backend="cuda", **small)
    same(result.beauty, wanted.beauty)
