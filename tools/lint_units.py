#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""lint_units.py COMPILE_COMMANDS OUT

Prepares linting in few large units: nearly all that a linter reads of a source is headers, the same
for its neighbours. Writes units that include the sources, the compile commands of the units and of
what stays alone, and prints the names of both. Sources that nothing else links to (tests,
benchmarks, snippets) come into a namespace of their own, so that their names do not meet, and the
headers stand before them; those that are compiled alike make a unit together, whatever their
folders. Of others each folder makes one.
"""

import collections
import itertools
import json
import pathlib
import re
import shutil
import sys

root = pathlib.Path(__file__).resolve().parent.parent
largest_unit = 60  # sources; 48 of them kept a core of a Zen 3 busy for 35 to 43 s


def is_linted(path: pathlib.Path) -> bool:
    """Only C++ of the repository; compile-fail tests are wrong on purpose."""
    inside = path.is_relative_to(root) and not path.is_relative_to(root / "build")
    return inside and path.suffix == ".cpp" and "compile_fail" not in path.parts


def is_independent(path: pathlib.Path) -> bool:
    return path.name.endswith("_test.cpp") or path.parent in (root / "bench", root / "docs/snippets")


def stays_alone(path: pathlib.Path) -> bool:
    """Programs of one file, and variants of which a build takes one."""
    programs = (root / "examples", root / "bench/micro")
    return (path.name == "main.cpp" or any(map(path.is_relative_to, programs))
            or "with" in path.name)


def includes_of(source: pathlib.Path) -> list[str]:
    includes = []
    for line in source.read_text().splitlines():
        # What lies beside the source is found from the unit by its full name.
        beside = re.match(r'#include "([^"/]+)"', line)
        if beside and (source.parent / beside[1]).exists():
            line = f'#include "{source.parent / beside[1]}"'
        if line.startswith("#include"):
            includes.append(line)
    return includes


def place_in_unit(source: pathlib.Path) -> tuple[bool, pathlib.Path]:
    """Templates are declared `extern` before the source that instantiates them."""
    return "\nextern template " not in source.read_text(), source


def unit_of(sources: list[pathlib.Path]) -> str:
    lines = []
    for source in filter(is_independent, sources):
        lines += includes_of(source)
    lines = list(dict.fromkeys(lines))
    for i, source in enumerate(sources):
        body = f'#include "{source}"  // NOLINT(bugprone-suspicious-include)'
        lines.append(f"namespace unit_{i} {{\n{body}\n}}" if is_independent(source) else body)
    return "\n".join(lines) + "\n"


def copy_rules(folder: pathlib.Path, out: pathlib.Path) -> None:
    """The rules of a folder hold for its unit."""
    while folder != root:
        rules = folder / ".clang-tidy"
        if rules.exists():
            to = out / folder.relative_to(root)
            to.mkdir(parents=True, exist_ok=True)
            shutil.copy(rules, to)
        folder = folder.parent


def rules_of(folder: pathlib.Path) -> pathlib.Path:
    """The folder whose rules hold for this one."""
    return folder if (folder / ".clang-tidy").exists() else rules_of(folder.parent)


def how_compiled(entry: dict) -> str:
    """The command without the names of its input and output."""
    return re.sub(r"\S*" + re.escape(pathlib.Path(entry["file"]).name) + r"\S*", "", entry["command"])


def family_of(path: pathlib.Path, entry: dict) -> tuple:
    """Sources of one family may share a unit."""
    if is_independent(path):
        return str(rules_of(path.parent)), how_compiled(entry)
    return str(path.parent), ""


def parts_of(sources: list[pathlib.Path]) -> list[list[pathlib.Path]]:
    """Neighbours together, in parts of about the same size."""
    count = -(-len(sources) // largest_unit)
    return [sources[len(sources) * i // count:len(sources) * (i + 1) // count] for i in range(count)]


def main() -> None:
    commands, out = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()
    entries = {pathlib.Path(e["file"]): e for e in json.loads(commands.read_text())}
    entries = {path: e for path, e in entries.items() if is_linted(path)}
    listed = [e for path, e in entries.items() if stays_alone(path)]
    families = collections.defaultdict(list)
    for path in sorted(path for path in entries if not stays_alone(path)):
        families[family_of(path, entries[path])].append(path)
    shutil.rmtree(out, ignore_errors=True)
    for part in itertools.chain.from_iterable(map(parts_of, families.values())):
        unit = out / part[0].relative_to(root).with_suffix("") / "unit.cpp"
        unit.parent.mkdir(parents=True)
        unit.write_text(unit_of(sorted(part, key=place_in_unit)))
        copy_rules(part[0].parent, out)
        first = entries[part[0]]
        command = first["command"].replace(first["file"], str(unit))
        listed.append({**first, "file": str(unit), "command": command})
    (out / "compile_commands.json").write_text(json.dumps(listed, indent=1))
    print("\n".join(e["file"] for e in listed))


if __name__ == "__main__":
    main()
