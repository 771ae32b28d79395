# SPDX-License-Identifier: MIT
"""A scene at a size: how `mir` is called for each of its pictures."""
import dataclasses
import hashlib
import pathlib
import shutil

import measure

LAYERS = {"whole": "", "indirect": "indirect"}  # what is measured, and its layer in the EXR


@dataclasses.dataclass(frozen=True)
class Job:
    mir: str
    scene: str  # file or builtin:NAME
    width: int
    height: int
    backend: str
    options: tuple  # of every picture, references included
    environment: tuple  # options of it
    hash: str  # of the scene
    program: str  # fingerprint of mir, whose seconds change with it

    @property
    def name(self):
        stem = self.scene.removeprefix("builtin:")
        return f"{pathlib.Path(stem).stem}-{self.width}x{self.height}"

    @property
    def key(self):
        """Everything that changes all of its pictures."""
        return [self.hash, self.width, self.height, self.backend, *self.options]

    def render(self, picture, options, layers="indirect"):
        """The command line of a picture. A box filter, which every renderer has alike."""
        return [self.mir, "render", self.scene, "-o", picture, "--no-png", "--quiet",
                "--aov", layers, "--filter", "box", "--width", self.width,
                "--height", self.height, "--backend", self.backend,
                *self.environment, *self.options, *options]


def make_job(mir, scene, size, backend, options, environment):
    """Reads the scene once, for its hash."""
    found = measure.run_json([mir, "info", scene, "--json", *environment])
    program = hashlib.sha256(pathlib.Path(shutil.which(mir)).read_bytes()).hexdigest()[:16]
    return Job(mir, scene, *size, backend, tuple(options), tuple(environment),
               found["scene_hash"], program)
