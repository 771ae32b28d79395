# SPDX-License-Identifier: MIT
"""Programs run one at a time: what they cost and what they print."""
import dataclasses
import json
import os
import subprocess
import tempfile
import time


class Failed(Exception):
    """A program did not start or ended with an error, whose last line is the message."""


@dataclasses.dataclass(frozen=True)
class Cost:
    """What a process took, from its start to its end."""
    cpu: float  # seconds of all threads, user and system: what other load changes least
    wall: float  # seconds
    megabytes: float  # most memory that was resident

    def __add__(self, other):
        return Cost(self.cpu + other.cpu, self.wall + other.wall,
                    max(self.megabytes, other.megabytes))


def start(command, out, err):
    try:
        return subprocess.Popen([str(word) for word in command], stdout=out, stderr=err)
    except OSError as error:
        raise Failed(f"{command[0]}: {error.strerror.lower()} (it cannot be started); give the "
                     "program by --mir") from error


def run(command):
    """Runs a program to its end. Returns its cost and its standard output."""
    with tempfile.TemporaryFile() as out, tempfile.TemporaryFile() as err:
        begin = time.perf_counter()
        process = start(command, out, err)
        _, status, usage = os.wait4(process.pid, 0)
        wall = time.perf_counter() - begin
        process.returncode = os.waitstatus_to_exitcode(status)
        texts = []
        for file in (out, err):
            file.seek(0)
            texts.append(file.read().decode(errors="replace"))
    if process.returncode != 0:
        lines = texts[1].strip().splitlines() or [f"exit code {process.returncode}"]
        raise Failed(f"{command[0]}: {lines[-1]}")
    return Cost(usage.ru_utime + usage.ru_stime, wall, usage.ru_maxrss / 1024), texts[0]


def run_json(command):
    """The JSON document that a program prints."""
    return json.loads(run(command)[1])
