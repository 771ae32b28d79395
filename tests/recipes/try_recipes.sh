#!/bin/sh
# SPDX-License-Identifier: MIT
#
# try_recipes.sh APPLY ROOT   shows that apply_recipes.sh can fail: makes one mistake of each kind in
# the patches or in the page, and wants each to be named.
set -eu
apply=$1
root=$(cd -- "$2" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# A tree of links, small enough to be copied at once, whose patches and page are files of its own.
fresh() {
    rm -rf "$work/tree"
    mkdir -p "$work/tree/docs" "$work/tree/tests"
    cd -- "$work/tree"
    for entry in .ci backends bench cmake examples farm include python src tools; do ln -s "$root/$entry" .; done
    for entry in CMakeLists.txt LICENSE pyproject.toml "$root"/*.md "$root"/*.sh; do
        ln -s "$root/$(basename "$entry")" .
    done
    for entry in "$root"/docs/*; do ln -s "$entry" docs; done
    for entry in "$root"/tests/*; do ln -s "$entry" tests; done
    rm docs/extending.md tests/recipes
    cp "$root/docs/extending.md" docs
    cp -R "$root/tests/recipes" tests
}

# tried WANTED: the tree is refused, and WANTED is said.
tried() {
    if sh "$apply" "$work/tree" >"$work/said"; then
        echo "not found: $1" >&2
        exit 1
    fi
    grep -q -- "$1" "$work/said" || { echo "not named: $1; said was:" >&2; cat "$work/said" >&2; exit 1; }
    fresh
}

# added PATH: a patch that makes a file of one line.
added() { printf -- '--- /dev/null\n+++ b/%s\n@@ -0,0 +1 @@\n+planted\n' "$1"; }

fresh
added src/io/planted.cpp >>tests/recipes/light.patch
tried 'light.patch touches src/io/planted.cpp, which its table does not name'

# The folder is named for new files alone.
printf -- '--- a/include/mir/sched/cpu.hpp\n+++ b/include/mir/sched/cpu.hpp\n@@ -1 +1 @@\n-%s\n+%s\n' \
    '// SPDX-License-Identifier: MIT' '// SPDX-License-Identifier: MIT ' >>tests/recipes/scheduler.patch
tried 'scheduler.patch touches include/mir/sched/cpu.hpp, which its table does not name'

sed '/^| `src\/io\/scene_reader.cpp` |/d' "$root/docs/extending.md" >docs/extending.md
tried 'file_format.patch touches src/io/scene_reader.cpp, which its table does not name'

sed 's/^| `src\/io\/scene_reader.cpp` |/| `src\/io\/scene_reader.cpp`, `src\/io\/png.cpp` |/' \
    "$root/docs/extending.md" >docs/extending.md
tried 'file_format.patch does not touch src/io/png.cpp, which its table names'

sed 's/^-\(.*DirectionalLight.*\)$/-\1 otherwise/' "$root/tests/recipes/light.patch" \
    >tests/recipes/light.patch
tried 'tests/recipes/light.patch no longer fits'

rm tests/recipes/light.patch
tried 'patches for [0-9]* tables'
