#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""lint_units.py COMPILE_COMMANDS OUT

Prepares linting in few large units: what a linter reads of one test is nearly all headers, the same
for its neighbours. Writes OUT/compile_commands.json with the sources of the repository, where the
tests of a folder are replaced by one unit OUT/FOLDER.cpp that includes their headers first and then
each of them inside a namespace of its own, so that their names do not meet.
"""

import json
import pathlib
import re
import sys


def is_linted(path: pathlib.Path, root: pathlib.Path) -> bool:
    """Only C++ of the repository; compile-fail tests are wrong on purpose."""
    inside = path.is_relative_to(root) and not path.is_relative_to(root / "build")
    return inside and path.suffix == ".cpp" and "compile_fail" not in path.parts


def unit_body(i: int, member: pathlib.Path) -> str:
    allowed = "// NOLINT(bugprone-suspicious-include)"
    return f'namespace unit_{i} {{\n#include "{member}"  {allowed}\n}}'


def unit_of(members: list[pathlib.Path]) -> str:
    includes = []
    for member in members:
        for line in member.read_text().splitlines():
            # A header beside the test is found from the unit by its full name.
            beside = re.match(r'#include "([^"/]+)"', line)
            if beside and (member.parent / beside[1]).exists():
                line = f'#include "{member.parent / beside[1]}"'
            if line.startswith("#include") and line not in includes:
                includes.append(line)
    bodies = [unit_body(i, m) for i, m in enumerate(members)]
    return "\n".join(includes + bodies) + "\n"


def main() -> None:
    commands, out = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()
    root = pathlib.Path(__file__).resolve().parent.parent
    out.mkdir(parents=True, exist_ok=True)
    kept, groups = [], {}
    for entry in json.loads(commands.read_text()):
        source = pathlib.Path(entry["file"])
        if not is_linted(source, root):
            continue
        if source.name.endswith("_test.cpp"):
            groups.setdefault(source.parent, []).append(entry)
        else:
            kept.append(entry)
    for folder, entries in sorted(groups.items()):
        unit = out / ("_".join(folder.relative_to(root).parts) + ".cpp")
        members = sorted({pathlib.Path(e["file"]) for e in entries})
        unit.write_text(unit_of(members))
        command = entries[0]["command"].replace(entries[0]["file"], str(unit))
        kept.append({**entries[0], "file": str(unit), "command": command})
    unique = {e["file"]: e for e in kept}
    (out / "compile_commands.json").write_text(json.dumps(list(unique.values()), indent=1))
    print("\n".join(unique))


if __name__ == "__main__":
    main()
