# SPDX-License-Identifier: MIT
"""Pictures by several processes. Threads stand for them, and queues for what they talk by."""

import queue
import threading

import numpy as np
import pytest

import mir
import mir.team

LAYERS = ("beauty", "emission", "direct", "indirect", "albedo", "normal", "position", "depth")


class Threads:
    """One of several threads as Peers."""

    def __init__(self, boxes, number):
        self.boxes = boxes
        self.number = number

    def rank(self):
        return self.number

    def count(self):
        return len(self.boxes)

    def send(self, to, message):
        self.boxes[to].put((self.number, message))

    def receive(self):
        try:
            return self.boxes[self.number].get_nowait()
        except queue.Empty:
            return None


def as_team(work, count=3, kind=Threads):
    """What work(peers) returns or raises, by the number of the process."""
    boxes = [queue.SimpleQueue() for _ in range(count)]
    found = [None] * count

    def be(number):
        try:
            found[number] = work(kind(boxes, number))
        except BaseException as raised:
            found[number] = raised

    threads = [threading.Thread(target=be, args=(i,)) for i in range(count)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(300)
        assert not thread.is_alive()
    return found


@pytest.mark.parametrize("more", [{}, {"passes": 2}, {"integrator": "path", "samples": 2}])
def test_the_lead_gets_the_bits_of_one_process(room, small, more):
    settings = {**small, "height": 70, **more}
    one = mir.render(room, **settings)
    lead, *others = as_team(lambda peers: mir.team.render(room, peers, **settings))
    assert others == [None, None]
    assert one.beauty.max() > 0
    for name in LAYERS:
        np.testing.assert_array_equal(getattr(lead, name), getattr(one, name))
    assert lead.warnings == one.warnings


def test_one_process_is_a_team(room, small):
    (lead,) = as_team(lambda peers: mir.team.render(room, peers, **small), count=1)
    np.testing.assert_array_equal(lead.beauty, mir.render(room, **small).beauty)


def errors_of(work, **how):
    found = as_team(work, **how)
    assert all(isinstance(error, mir.Error) for error in found), found
    return found


@pytest.mark.parametrize("guilty", [0, 2])
@pytest.mark.parametrize(
    ("scene", "settings", "code", "words"),
    [
        ("/nowhere.glb", {}, "invalid_input", "nowhere.glb"),
        ("builtin:sphere", {"vpls": 0}, "invalid_argument", "--vpls: 0 is out of range"),
        ("builtin:cornell-box", {}, "invalid_input", "another scene"),
        ("builtin:sphere", {"scheduler": "nobody"}, "invalid_argument", "nobody"),
        (3, {}, "invalid_argument", "int is no scene"),
    ],
)
def test_what_fails_in_one_is_an_error_of_all(small, guilty, scene, settings, code, words):
    def work(peers):
        if peers.rank() == guilty:
            return mir.team.render(scene, peers, **{**small, **settings})
        return mir.team.render("builtin:sphere", peers, **small)

    for error in errors_of(work):
        assert error.code == code
        assert words in str(error)


@pytest.mark.parametrize("guilty", [0, 1])
def test_what_a_callback_raises_ends_all(small, guilty):
    class Stop(Exception):
        pass

    def stop(_):
        raise Stop("enough")

    def work(peers):
        progress = stop if peers.rank() == guilty else None
        return mir.team.render(
            "builtin:sphere", peers, progress=progress, **{**small, "vpls": 65536}
        )

    found = as_team(work)
    assert isinstance(found.pop(guilty), Stop)
    assert [error.code for error in found] == ["cancelled"] * 2


class Deaf(Threads):
    """Threads of which number 1 hears no more after some messages."""

    heard = 0

    def receive(self):
        letter = super().receive()
        if self.number == 1 and letter:
            self.heard += 1
            if self.heard == 3:
                raise ConnectionError("the line is dead")
        return letter


class Babbler(Threads):
    """Threads of which number 1 gives no bytes."""

    babbled = False

    def receive(self):
        if self.number == 1 and not self.babbled:
            self.babbled = True
            return "a letter"
        return super().receive()


@pytest.mark.parametrize(
    ("kind", "code", "words"),
    [
        (Deaf, "device", "ConnectionError: the line is dead"),
        (Babbler, "invalid_argument", "receive() gives no pair"),
    ],
)
def test_peers_that_fail_are_an_error_of_all(room, small, kind, code, words):
    for error in errors_of(lambda peers: mir.team.render(room, peers, **small), kind=kind):
        assert error.code == code
        assert words in str(error)


@pytest.mark.parametrize(("rank", "count"), [(2, 2), (-1, 2), ("first", 2), (0, None)])
def test_numbers_that_cannot_be(room, rank, count):
    class Wrong(Threads):
        def rank(self):
            return rank

        def count(self):
            return count

    with pytest.raises(mir.Error) as raised:
        mir.team.render(room, Wrong([], 0))
    assert (raised.value.code, raised.value.place) == ("invalid_argument", "peers")
