# SPDX-License-Identifier: MIT
"""Pictures by the ranks of MPI. Needs mpi4py, which brings MPI; mir itself has none."""

import time

from mpi4py import MPI

from mir import team
from mir._core import Result
from mir._error import Error
from mir._render import ProgressCallback

_PART = 1 << 30  # MPI counts bytes by int


def _await(request) -> None:
    """Waits in sleep: MPI's own waiting keeps a core busy."""
    while not request.Test():
        time.sleep(5e-5)


class _Ranks:
    """Ranks of a communicator as Peers. A message goes in parts, of which the last is not full."""

    def __init__(self, comm):
        self._comm = comm

    def rank(self) -> int:
        return self._comm.Get_rank()

    def count(self) -> int:
        return self._comm.Get_size()

    def send(self, to: int, message: bytes) -> None:
        for begin in range(0, len(message) + 1, _PART):
            part = memoryview(message)[begin : begin + _PART]
            _await(self._comm.Isend([part, MPI.BYTE], to))

    def receive(self) -> tuple[int, bytes] | None:
        status = MPI.Status()
        if not self._comm.Iprobe(status=status):
            return None
        sender = status.Get_source()
        parts = [self._take(status)]
        while len(parts[-1]) == _PART:
            self._comm.Probe(sender, status=status)
            parts.append(self._take(status))
        return sender, b"".join(parts)

    def _take(self, status) -> bytearray:
        part = bytearray(status.Get_count(MPI.BYTE))
        self._comm.Recv([part, MPI.BYTE], status.Get_source(), status.Get_tag())
        return part


def _check_mpi() -> None:
    if not MPI.Is_initialized() or MPI.Is_finalized():
        raise Error(
            "ranks were to render before MPI began, or behind its end; call MPI.Init_thread() before",
            "invalid_argument",
            "comm",
        )
    if MPI.Query_thread() < MPI.THREAD_SERIALIZED:
        raise Error(
            "MPI was begun for fewer threads than a render has; leave mpi4py.rc.thread_level as it "
            'is, or set it to "serialized"',
            "invalid_argument",
            "comm",
        )


def render(scene, comm=None, *, progress: ProgressCallback = None, **settings) -> Result | None:
    """Renders one picture by all ranks of a communicator.

    comm: of mpi4py; None: MPI.COMM_WORLD. All its ranks call this with the same scene and settings;
    threads, devices and tiles may differ. Messages go over a copy of it, so that they meet no
    others. Ranks that wait leave their cores to others.

    Rank 0 gets the picture, in every bit that of mir.render(), the others None. Where one rank
    fails, all raise mir.Error; one whose own Python failed raises that. The other arguments are
    those of mir.render().
    """
    _check_mpi()
    copy, copied = (MPI.COMM_WORLD if comm is None else comm).Idup()
    _await(copied)
    try:
        copy.Set_errhandler(MPI.ERRORS_RETURN)
        return team.render(scene, _Ranks(copy), progress=progress, **settings)
    finally:
        copy.Free()
