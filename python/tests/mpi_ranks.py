# SPDX-License-Identifier: MIT
"""What each rank of test_mpi.py does. Says "done" when all was right."""

import time

import mpi4py

import mir

try:
    mpi4py.rc.initialize = False
    from mpi4py import MPI

    import mir.mpi

    mir.mpi.render("builtin:sphere")
    raise AssertionError("rendered before MPI began")
except mir.Error as error:
    assert "before MPI began" in str(error), error

MPI.Init_thread(MPI.THREAD_MULTIPLE)
WORLD = MPI.COMM_WORLD
SMALL = {"width": 40, "height": 70, "vpls": 32, "luxels": 1, "direct_samples": 4, "threads": 1}


def error_of_all(words, scene="builtin:sphere", **settings):
    """All raise the same error when one rank's arguments are wrong."""
    try:
        mir.mpi.render(scene, **{**SMALL, **settings})
        raise AssertionError(f"no error: {words}")
    except mir.Error as error:
        assert words in str(error), error
        codes = WORLD.allgather(error.code)
        assert len(set(codes)) == 1, codes


def stop(_):
    raise StopIteration


def seconds_of_core(work):
    begin = time.process_time()
    work()
    return time.process_time() - begin


# What a program sends itself is not taken for a message of the team.
own = WORLD.isend("own", (WORLD.rank + 1) % WORLD.size)
for settings in ({}, {"passes": 2}):
    picture = mir.mpi.render("builtin:cornell-box", **SMALL, **settings)
    assert (picture is not None) == (WORLD.rank == 0)
    if picture:
        picture.save("ranks.exr")
        mir.render("builtin:cornell-box", **SMALL, **settings).save("one.exr")
        with open("ranks.exr", "rb") as found, open("one.exr", "rb") as wanted:
            assert found.read() == wanted.read(), settings
assert WORLD.recv(source=(WORLD.rank - 1) % WORLD.size) == "own"
own.wait()

error_of_all("another scene", "builtin:cornell-box" if WORLD.rank == 1 else "builtin:sphere")
error_of_all("nowhere", "/nowhere.glb" if WORLD.rank == 2 else "builtin:sphere")
error_of_all("out of range", vpls=0 if WORLD.rank == 0 else 32)
try:
    long = {**SMALL, "vpls": 65536}
    mir.mpi.render("builtin:sphere", progress=stop if WORLD.rank == 1 else None, **long)
    raise AssertionError("a picture that was stopped")
except (StopIteration, mir.Error) as raised:
    assert isinstance(raised, StopIteration) == (WORLD.rank == 1), raised

# Messages in parts, by ranks of a part of the world in another order.
mir.mpi._PART = 1000
pair = WORLD.Split(WORLD.rank == 0, -WORLD.rank)
picture = mir.mpi.render("builtin:cornell-box", pair, **SMALL, passes=2)
if pair.rank == 0:
    picture.save(f"parts{WORLD.rank}.exr")
    with open(f"parts{WORLD.rank}.exr", "rb") as found, open("one.exr", "rb") as wanted:
        assert found.read() == wanted.read(), "in parts"

# A rank that waits leaves its core to others.
WORLD.Barrier()
busy = seconds_of_core(lambda: mir.mpi.render("builtin:sphere", **SMALL))
WORLD.Barrier()
if WORLD.rank == 0:
    time.sleep(2)
waiting = seconds_of_core(lambda: mir.mpi.render("builtin:sphere", **SMALL))
assert WORLD.rank == 0 or waiting < busy + 0.4, (busy, waiting)
MPI.Finalize()
print("done")
