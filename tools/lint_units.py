#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""lint_units.py COMPILE_COMMANDS OUT

Prepares linting in few large units: nearly all that a linter reads of a source is headers, the same
for its neighbours. Writes units that include the sources, and their compile commands, and prints the
names of the units. Sources that nothing else links to (tests, benchmarks, snippets, those with
main()) come into a namespace of their own, so that their names do not meet, and the headers stand
before them; they make units together, whatever their programs, which see the include folders and
definitions of all. Of others each program or library makes one.
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
    if path.name.endswith("_test.cpp") or path.parent in (root / "bench", root / "docs/snippets"):
        return True
    # Inside another namespace, one of that name would not be its headers'.
    text = path.read_text()
    return "\nint main(" in text and not re.search(r"\nnamespace \w", text)


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
    # Once each, whatever the quotes.
    lines = list({re.sub('[<>"]', "", line): line for line in lines}.values())
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


def family_of(path: pathlib.Path, entry: dict) -> str:
    """Sources of one family may share a unit."""
    if is_independent(path):
        return str(rules_of(path.parent))
    return re.search(r" -o (\S*CMakeFiles/[^/]+)/", entry["command"])[1]


def command_of(unit: pathlib.Path, entries: list[dict]) -> str:
    """That of the first, with what the others find and define besides."""
    command = entries[0]["command"].replace(entries[0]["file"], str(unit))
    flags = itertools.chain.from_iterable(
        re.findall(r"-(?:I|D|isystem )\S+", entry["command"]) for entry in entries)
    more = [flag for flag in dict.fromkeys(flags) if f" {flag} " not in command]
    return " ".join([command, *more])


def parts_of(sources: list[pathlib.Path]) -> list[list[pathlib.Path]]:
    """Neighbours together, in parts of about the same size."""
    count = -(-len(sources) // largest_unit)
    return [sources[len(sources) * i // count:len(sources) * (i + 1) // count] for i in range(count)]


def main() -> None:
    commands, out = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()
    entries = {pathlib.Path(e["file"]): e for e in json.loads(commands.read_text())}
    families = collections.defaultdict(list)
    for path in sorted(filter(is_linted, entries)):
        families[family_of(path, entries[path])].append(path)
    shutil.rmtree(out, ignore_errors=True)
    listed = []
    for part in itertools.chain.from_iterable(map(parts_of, families.values())):
        unit = out / part[0].relative_to(root).with_suffix("") / "unit.cpp"
        unit.parent.mkdir(parents=True)
        unit.write_text(unit_of(sorted(part, key=place_in_unit)))
        copy_rules(part[0].parent, out)
        command = command_of(unit, [entries[path] for path in part])
        listed.append({**entries[part[0]], "file": str(unit), "command": command})
    (out / "compile_commands.json").write_text(json.dumps(listed, indent=1))
    print("\n".join(e["file"] for e in listed))


if __name__ == "__main__":
    main()
