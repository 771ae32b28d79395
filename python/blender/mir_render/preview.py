# SPDX-License-Identifier: MIT
"""A picture that becomes better while Blender goes on: a thread of its own renders it."""

import threading
from dataclasses import dataclass

import mir
import numpy as np

from .export_camera import View
from .passes import combined


class _Outdated(Exception):
    """Nobody wants this picture any more."""


@dataclass(frozen=True)
class Step:
    """One picture: all passes of a size."""

    view: View
    settings: dict  # of mir.progressive()


@dataclass(frozen=True)
class Job:
    """Pictures of a scene, one after the other, each better than the one before."""

    scene: mir.Scene
    steps: list[Step]
    transparent: bool = False


class Preview:
    """Renders the newest job. It reads no data of Blender's, whose threads may write them."""

    def __init__(self, redraw):
        """redraw: is called in the thread after each change of `picture` or `message`."""
        self.picture: np.ndarray | None = None  # (h, w, 4), the top row first
        self.message = ""
        self._redraw = redraw
        self._lock = threading.Lock()
        self._next: Job | None = None
        self._thread: threading.Thread | None = None
        self._stopped = False

    def begin(self, job: Job) -> None:
        """Leaves what it does for this job. Returns at once."""
        with self._lock:
            self._next = job
            if self._thread is None:
                self._thread = threading.Thread(target=self._work, name="mir preview")
                self._thread.start()

    def stop(self) -> None:
        """Ends it for good. Returns at once."""
        self._stopped = True

    def wait(self) -> None:
        """Waits until all is done."""
        thread = self._thread
        if thread is not None:
            thread.join()

    def _take(self) -> Job | None:
        with self._lock:
            job, self._next = self._next, None
            if job is None or self._stopped:
                self._thread = None
                return None
            return job

    def _work(self) -> None:
        while (job := self._take()) is not None:
            try:
                self._render(job)
            except _Outdated:
                pass
            except ReferenceError:  # the 3D view is gone
                self.stop()
            except mir.Error as error:
                self._show(self.picture, str(error))

    def _render(self, job: Job) -> None:
        for step in job.steps:
            camera = step.view.add_to(job.scene)
            pictures = mir.progressive(
                job.scene, camera=camera, progress=self._stop_if_outdated, **step.settings
            )
            for done, result in enumerate(pictures, 1):
                picture = step.view.window.cut(combined(result, job.transparent))
                self._stop_if_outdated()
                self._show(picture, f"Pass {done} of {step.settings['passes']}")

    def _stop_if_outdated(self, _progress=None) -> None:
        if self._stopped or self._next is not None:
            raise _Outdated

    def _show(self, picture: np.ndarray | None, message: str) -> None:
        self.picture, self.message = picture, message
        self._redraw()
