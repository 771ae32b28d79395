#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""lint_units.py COMPILE_COMMANDS OUT

Prepares linting in few large units: nearly all that a linter reads of a source is headers, the same
for its neighbours. Writes one unit per folder that includes its sources, the compile commands of
the units and of what stays alone, and prints the names of both. Sources that nothing else links to
(tests, benchmarks, snippets) come into a namespace of their own, so that their names do not meet;
the headers stand before them.
"""

import json
import pathlib
import re
import shutil
import sys

root = pathlib.Path(__file__).resolve().parent.parent


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


def main() -> None:
    commands, out = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()
    entries = {pathlib.Path(e["file"]): e for e in json.loads(commands.read_text())}
    entries = {path: e for path, e in entries.items() if is_linted(path)}
    listed = [e for path, e in entries.items() if stays_alone(path)]
    folders = sorted({path.parent for path in entries if not stays_alone(path)})
    for folder in folders:
        sources = sorted((p for p in entries if p.parent == folder and not stays_alone(p)),
                         key=place_in_unit)
        unit = out / folder.relative_to(root) / "unit.cpp"
        unit.parent.mkdir(parents=True, exist_ok=True)
        unit.write_text(unit_of(sources))
        copy_rules(folder, out)
        first = entries[sources[0]]
        command = first["command"].replace(first["file"], str(unit))
        listed.append({**first, "file": str(unit), "command": command})
    (out / "compile_commands.json").write_text(json.dumps(listed, indent=1))
    print("\n".join(e["file"] for e in listed))


if __name__ == "__main__":
    main()
