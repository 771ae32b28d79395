#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Plants the faults of tools/faults.txt, one at a time, and says which of them the tests find.

    tools/mutate.py --check                         every fault still fits the source
    tools/mutate.py --tree COPY --results FILE      runs what FILE has no result of yet

COPY is a configured clone that nobody else works in (cmake --preset cpu): its headers are changed
and put back. A fault in include/mir/ROOM/ meets the tests of that room alone, test_ROOM, without
the extended ones. Results are lines "STATE TAB FAULT"; the state is found (a test failed), stopped
(the tests took too long or crashed), refused (it does not compile) or survived. Ends with 1 when
one survived that tools/faults.txt does not explain. Takes about a minute a fault; not for CI.
"""
import argparse
import os
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
TABLE = ROOT / "tools" / "faults.txt"


class Fault:
    """One changed piece of one header; `why` explains why no test can find it."""

    def __init__(self, path, old, new, why):
        self.path, self.old, self.new, self.why = path, old, new, why

    @property
    def room(self):
        return self.path.split("/")[0]

    def __str__(self):
        return f"{self.path}: {self.old} -> {self.new}"


def faults():
    """The table: '@ FILE' names a header, '- OLD' and '+ NEW' a fault in it, '? WHY' explains."""
    path, old, listed = None, None, []
    for number, line in enumerate(TABLE.read_text().splitlines(), 1):
        kind, text = line[:2], line[2:]
        if not line or line.startswith("#"):
            continue
        if kind == "@ ":
            path = text
        elif kind == "- ":
            old = text
        elif kind == "+ " and old is not None:
            listed.append(Fault(path, old, text, None))
            old = None
        elif kind == "? " and listed:
            listed[-1].why = text
        else:
            sys.exit(f"{TABLE}:{number}: cannot read '{line}'")
    return listed


def source(tree, fault):
    return tree / "include" / "mir" / fault.path


def misfits(tree, listed):
    """Faults whose piece does not occur exactly once, or whose header is no more."""
    def fits(fault):
        header = source(tree, fault)
        return header.is_file() and header.read_text().count(fault.old) == 1

    return [f for f in listed if not fits(f)]


def run(tree, fault, jobs, seconds):
    """Builds and runs the room's tests; the state of the fault."""
    build = tree / "build" / "cpu"
    target = f"test_{fault.room}"
    if subprocess.run(["ninja", "-C", build, f"-j{jobs}", target],
                      capture_output=True).returncode != 0:
        return "refused"
    try:
        tests = subprocess.run([build / "bin" / target, "~[extended]", "--abort"],
                               capture_output=True, timeout=seconds)
    except subprocess.TimeoutExpired:
        return "stopped"
    if tests.returncode == 0:
        return "survived"
    return "found" if tests.returncode > 0 else "stopped"


def planted(tree, fault, jobs, seconds):
    """The same with the fault in the source, which is put back whatever happens."""
    path = source(tree, fault)
    right = path.read_text()
    path.write_text(right.replace(fault.old, fault.new))
    try:
        return run(tree, fault, jobs, seconds)
    finally:
        path.write_text(right)


def known_results(path):
    if not path.exists():
        return {}
    return dict(reversed(line.split("\t", 1)) for line in path.read_text().splitlines())


def report(listed, results):
    states = [results.get(str(f)) for f in listed]
    done = [s for s in states if s]
    print(f"{len(done)} of {len(listed)} faults run: " +
          ", ".join(f"{done.count(s)} {s}" for s in sorted(set(done))))
    survivors = [f for f, s in zip(listed, states) if s == "survived"]
    for f in survivors:
        print(f"survived{' (' + f.why + ')' if f.why else ''}: {f}")
    return any(not f.why for f in survivors)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--check", action="store_true", help="only check that faults fit")
    parser.add_argument("--tree", type=pathlib.Path, help="configured clone to plant them in")
    parser.add_argument("--results", type=pathlib.Path, help="file of results, kept up to date")
    parser.add_argument("--room", help="only faults of include/mir/ROOM")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="compilers at a time")
    parser.add_argument("--seconds", type=float, default=300,
                        help="longest time the tests of a room may take (%(default)s)")
    o = parser.parse_args()
    listed = [f for f in faults() if o.room in (None, f.room)]
    wrong = misfits(o.tree or ROOT, listed)
    if wrong:
        sys.exit("\n".join(f"does not occur exactly once: {f}" for f in wrong))
    if o.check:
        return print(f"{len(listed)} faults fit")
    if not o.tree or not o.results or o.tree.resolve() == ROOT:
        sys.exit("name a clone to plant faults in (--tree) and a file of results (--results)")
    results = known_results(o.results)
    for f in listed:
        if str(f) in results:
            continue
        results[str(f)] = planted(o.tree, f, o.jobs, o.seconds)
        with o.results.open("a") as out:
            out.write(f"{results[str(f)]}\t{f}\n")
        print(f"{results[str(f)]:9}{f}", flush=True)
    sys.exit(report(listed, results))


if __name__ == "__main__":
    main()
