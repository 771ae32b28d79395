#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""kills_test.py shards FOLDER MIR | ranks FOLDER MIR MPIEXEC MIR_MPI

Kills a render with --resume 20 times at random moments, starts it again each time, and compares
its bytes with those of a render that nobody killed. Prints what each kill left. Moments, ranks and
how many they are come from one seed; what a kill meets depends on the machine.
Exit code 77: skipped, for the reason that is printed.
"""
import hashlib
import os
import pathlib
import random
import shutil
import signal
import struct
import subprocess
import sys
import time

SEED = 51
KILLS = 20
SHARDS = 3
RENDER = ["render", "builtin:sphere", "--width", "80", "--height", "90", "--vpls", "128",
          "--backend", "cpu", "--threads", "1", "--quiet", "--passes"]
RESUMED = ["--resume", "--save-every", "0"]
ANY_RANKS = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
             "OMPI_MCA_rmaps_base_oversubscribe": "1", "OMPI_MCA_hwloc_base_binding_policy": "none",
             "OMPI_MCA_btl_vader_single_copy_mechanism": "none",
             "OMPI_MCA_orte_tmpdir_base": os.environ.get("TMPDIR", "/tmp")}


def run(*command):
    """Runs a command to its end; returns its seconds."""
    begin = time.monotonic()
    done = subprocess.run(command, text=True, capture_output=True, check=False)
    if done.returncode != 0:
        sys.exit(f"{' '.join(command)}\nended with {done.returncode}: {done.stderr}")
    return time.monotonic() - begin


def digest(path):
    return hashlib.sha256(path.read_bytes()).hexdigest()


def kept_in_shard(shard):
    return "shard " + (digest(shard)[:16] if shard.exists() else "none")


def kept_by_ranks(picture):
    """Passes and the bands of the one under way, which rank 0 keeps beside the picture."""
    passes = 0
    if picture.exists():
        name = b"mir:passes\0int\0"
        data = picture.read_bytes()
        passes, = struct.unpack_from("<i", data, data.index(name) + len(name) + 4)
    bands = picture.with_name(picture.name + ".bands")
    return f"{passes} passes, bands {digest(bands)[:16] if bands.exists() else 'none'}"


def one_of(pid, count, rng):
    """A rank that mpiexec has started, and what to call it; mpiexec where there is none yet."""
    children = pathlib.Path(f"/proc/{pid}/task/{pid}/children").read_text(encoding="ascii").split()
    if not children:
        return pid, f"mpiexec of {count}"
    rank = rng.randrange(len(children))
    return int(children[rank]), f"rank {rank} of {count}"


class Kills:
    """Starts commands and kills them."""

    def __init__(self, longest):
        self.rng = random.Random(SEED)
        self.longest = longest
        self.count = self.costly = 0
        self.kept = {}
        print(f"seed {SEED}, moments up to {longest:.3f} s\n"
              "kill  moment  victim            kept behind it")

    def kill(self, command, victim_of, look, file):
        """Kills what `victim_of` names of a command, and sees by `look` what is kept in `file`."""
        nothing = look(file.with_name("absent"))
        while not (name := self.strike(command, victim_of)):
            # All was done before the moment: again from nothing, sooner.
            for kept in file.parent.glob(file.stem + ".*"):
                kept.unlink()
            self.kept[file] = nothing
            self.longest /= 2
            print(f"      all done, from now on moments up to {self.longest:.3f} s")
        kept = look(file)
        self.count += 1
        self.costly += kept != self.kept.get(file, nothing)
        self.kept[file] = kept
        print(f"{self.count:4}  {self.moment:6.3f}  {name:16}  {kept}", flush=True)

    def strike(self, command, victim_of):
        """The name of what it killed under way; empty where the command had ended."""
        self.moment = self.rng.uniform(0.0, self.longest)
        with subprocess.Popen(command, stdout=subprocess.DEVNULL,
                              stderr=subprocess.DEVNULL) as started:
            time.sleep(self.moment)
            if started.poll() is not None:
                return ""
            victim, name = victim_of(started.pid)
            try:
                os.kill(victim, signal.SIGKILL)
            except ProcessLookupError:
                pass
            return name if started.wait() != 0 else ""

    def check(self):
        print(f"{self.count} kills under way, {self.costly} of them after something more was kept")
        if self.costly < KILLS // 4:
            sys.exit("too few kills came when there was something to lose")


def same(whole, picture):
    for ending in (".exr", ".png"):
        a, b = (path.with_suffix(ending) for path in (whole, picture))
        print(f"{digest(a)}  {a.name}\n{digest(b)}  {b.name}")
        if digest(a) != digest(b):
            sys.exit(f"{b.name} has other bytes than {a.name}")


def shards(folder, passes, seconds, mir):
    kills = Kills(seconds / 10)
    files = [folder / f"{number}.shard" for number in range(1, SHARDS + 1)]
    commands = [[mir, *RENDER, passes, *RESUMED, "--shard", f"{number}/{SHARDS}", "-o", str(file)]
                for number, file in enumerate(files, 1)]
    for i in range(KILLS):
        of = i % SHARDS
        kills.kill(commands[of], lambda pid, of=of: (pid, f"shard {of + 1}"), kept_in_shard,
                   files[of])
    kills.check()
    for command in commands:
        run(*command)
    run(mir, "merge", "--quiet", *map(str, reversed(files)), "-o", str(folder / "merged.exr"))
    return folder / "merged.exr"


def ranks(folder, passes, seconds, mpiexec, mir_mpi):
    kills = Kills(seconds / 16)
    picture = folder / "ranks.exr"

    def command(count):
        return [mpiexec, "-n", str(count), mir_mpi, *RENDER, passes, *RESUMED, "-o", str(picture)]

    for _ in range(KILLS):
        count = kills.rng.choice([2, 3, 3, 4])
        kills.kill(command(count), lambda pid, count=count: one_of(pid, count, kills.rng),
                   kept_by_ranks, picture)
    kills.check()
    run(*command(3))
    return picture


def skip_without_ranks(mpiexec):
    os.environ.update(ANY_RANKS)
    tried = subprocess.run([mpiexec, "-n", "2", "true"], text=True, capture_output=True,
                           check=False)
    if tried.returncode != 0:
        print(f"skipped: ranks cannot be started here ({tried.stderr.strip()[-200:]})")
        sys.exit(77)


def main():
    which, place, mir, *mpi = sys.argv[1:]
    if which == "ranks":
        skip_without_ranks(mpi[0])
    folder = pathlib.Path(place)
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    whole = folder / "whole.exr"
    # So many that 20 kills come before the end: each process does again what is no band.
    passes = "16" if which == "shards" else "32"
    seconds = run(mir, *RENDER, passes, "-o", str(whole))
    make = shards if which == "shards" else ranks
    same(whole, make(folder, passes, seconds, *(mpi or [mir])))


if __name__ == "__main__":
    main()
