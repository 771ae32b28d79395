# SPDX-License-Identifier: MIT
"""Two independent references by the path tracer, kept in a folder and used again."""
import hashlib
import json

import measure

SEEDS = (20260001, 20260002)  # of no measured picture
LUXELS = 64  # most luxels of a pixel


class References:
    """Both pictures of one scene, and their own error."""

    def __init__(self, job, folder, samples):
        self.files = [self._find(job, folder, samples, seed) for seed in SEEDS]
        self._job = job

    def names(self):
        """Names of their files, which tell all that they depend on."""
        return [file.name for file in self.files]

    def error_of(self, picture, layer):
        """Estimates the scaled relMSE of a picture without the noise of the references."""
        return self._compare(picture, layer, ["--second-reference", self.files[1]])

    def own_error(self, layer):
        """Scaled relMSE of one of them: half of what both differ by."""
        found = self._compare(self.files[1], layer, [])
        return {key: 0.5 * found[key] for key in ("mean", "trimmed")}

    def _compare(self, picture, layer, options):
        command = [self._job.mir, "compare", picture, self.files[0], "--json", *options]
        if layer:
            command += ["--layer", layer]
        return measure.run_json(command)["scaled_relmse"]

    @staticmethod
    def _find(job, folder, samples, seed):
        luxels = min(samples, LUXELS)
        options = ["--integrator", "path", "--luxels", luxels, "--samples", samples // luxels]
        settings = json.dumps([job.key, samples, seed])
        name = f"{job.name}-{hashlib.sha256(settings.encode()).hexdigest()[:16]}.exr"
        if not (folder / name).exists():
            print(f"{job.name}: reference of {samples} paths a pixel", flush=True)
            folder.mkdir(parents=True, exist_ok=True)
            # A name of its own, so that a reference that is there is a whole one.
            unfinished = folder / ("unfinished-" + name)
            measure.run(job.render(unfinished, [*options, "--seed", seed]))
            unfinished.replace(folder / name)
        return folder / name
