# SPDX-License-Identifier: MIT
"""Renders that are cancelled, and renders beside each other."""

import gc
import os
import random
import resource
import signal
import threading
import time

import numpy as np
import pytest

import mir

LONG = {"width": 320, "height": 240, "vpls": 4096, "luxels": 4}


class Stop(Exception):
    """What a callback raises."""


def stop_after(seconds):
    begin = time.perf_counter()

    def look(progress):
        if time.perf_counter() - begin > seconds:
            raise Stop

    return look


def test_an_exception_of_the_callback_cancels():
    begin = time.perf_counter()
    with pytest.raises(Stop):
        mir.render("builtin:sphere", progress=stop_after(0), **LONG)
    assert time.perf_counter() - begin < 5.0


def test_ctrl_c_cancels():
    timer = threading.Timer(0.3, os.kill, (os.getpid(), signal.SIGINT))
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        mir.render("builtin:sphere", **{**LONG, "vpls": 65536})
    timer.join()


def memory_now():
    """Resident bytes."""
    with open("/proc/self/statm") as file:
        return int(file.read().split()[1]) * resource.getpagesize()


@pytest.mark.parametrize("times", [10, pytest.param(100, marks=pytest.mark.extended)])
def test_renders_are_cancelled_at_random_moments_without_a_leak(times):
    scene = mir.load("builtin:sphere")
    dice = random.Random(1)

    def cancel():
        with pytest.raises(Stop):
            mir.render(scene, progress=stop_after(dice.uniform(0, 0.5)), **LONG)
        gc.collect()

    for _ in range(10):
        cancel()
    before = memory_now()
    for _ in range(times):
        cancel()
    # A leaked frame or picture of each would be 8 MB and more; the heap itself grows by some 50 MB.
    assert memory_now() - before < times * 1_000_000 + 64_000_000
    scene.add_material()


def test_a_progressive_render_goes_on_after_it_was_cancelled(small):
    passes = mir._core._Progressive(mir.load("builtin:sphere"), ["--passes=2", "--vpls=16"])
    with pytest.raises(Stop):
        passes.next(stop_after(-1))
    assert passes.next(None)


def test_two_renders_at_once(room, small):
    wanted = mir.render(room, **small).beauty
    found = [None] * 4

    def work(i):
        found[i] = mir.render(room, **small).beauty

    threads = [threading.Thread(target=work, args=(i,)) for i in range(len(found))]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    for picture in found:
        np.testing.assert_array_equal(picture, wanted)


def test_the_gil_is_free_meanwhile():
    counted = 0
    done = threading.Event()

    def work():
        mir.render("builtin:sphere", width=160, height=120, vpls=512)
        done.set()

    thread = threading.Thread(target=work)
    thread.start()
    while not done.is_set():
        counted += 1
        time.sleep(0.001)
    thread.join()
    assert counted > 20


def test_progress_tells_what_is_done():
    told = []
    mir.render(
        "builtin:sphere",
        width=160,
        height=120,
        vpls=1024,
        progress=lambda p: told.append((p.stage, p.share, p.seconds, p.done)),
    )
    assert told[-1][1] == 1.0 and told[-1][3]
    assert all(a[2] <= b[2] for a, b in zip(told, told[1:]))
