# SPDX-License-Identifier: MIT
"""Pictures that several processes make together, which talk by an object of yours."""

from typing import Protocol

from mir import _core
from mir._core import Result
from mir._error import Error
from mir._progress import callback_of
from mir._render import ProgressCallback, _scene_of
from mir._words import words_of


class Peers(Protocol):
    """Messages among processes. Process 0 leads: the others send to it, and it to them.

    Messages from one process to another arrive in the order in which they were sent. render() calls
    the methods from a thread of its own, one at a time. What they raise ends the picture.
    """

    def rank(self) -> int:
        """Number of this process, from 0."""

    def count(self) -> int:
        """Number of all processes."""

    def send(self, to: int, message: bytes) -> None:
        """Sends a message; may wait until it is received."""

    def receive(self) -> tuple[int, bytes] | None:
        """Sender and bytes of a message that has come, None without one; does not wait."""


def render(scene, peers: Peers, *, progress: ProgressCallback = None, **settings) -> Result | None:
    """Renders one picture by all processes of `peers`.

    All call it with the same scene and settings; threads, devices and tiles may differ. Process 0
    gets the picture, in every bit that of mir.render(), the others None. Where one of them fails,
    all raise mir.Error; one whose own Python failed raises that. The arguments are those of
    mir.render().
    """
    team = _core._Team(peers)
    try:
        return team.render(_scene_of(scene), words_of(settings), callback_of(progress))
    except Error as reason:
        team.fail(reason.code, str(reason))
        raise
    except BaseException as reason:
        team.fail("cancelled", f"it was ended by {type(reason).__name__} ({reason}); start all again")
        raise
    finally:
        team.leave()
