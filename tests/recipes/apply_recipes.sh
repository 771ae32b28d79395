#!/bin/sh
# SPDX-License-Identifier: MIT
#
# apply_recipes.sh ROOT [COPY]   copies the tree at ROOT to the new folder COPY, or to one that is not
# kept, applies all patches of tests/recipes/ to it, one after the other, and holds the files that each
# touches to the table of its section in docs/extending.md ("## A light" for light.patch). Prints every
# breach; fails when there is one.
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
root=$(cd -- "$1" && pwd)
copy=${2:-$work/copy}
mkdir -- "$copy"
copy=$(cd -- "$copy" && pwd)
bad=$work/bad
: >"$bad"

breach() { printf '%s\n' "$*" | tee -a "$bad"; }

# must PATH, may PATH: what the rows of the table of a section name; those that begin with "where" may
# be left out.
rows() {
    awk -v title="$1" '
        /^## / { inside = tolower($0) == "## a " title; next }
        !/^\|/ { table = 0 }
        inside && /^\| File \| What to add \|$/ { table = 1; next }
        table && !/^\|---/ {
            split($0, cell, "|")
            kind = cell[3] ~ /^ where / ? "may" : "must"
            rest = cell[2]
            while (match(rest, /`[^`]*`/)) {
                print kind, substr(rest, RSTART + 1, RLENGTH - 2)
                rest = substr(rest, RSTART + RLENGTH)
            }
        }' "$root/docs/extending.md"
}

# new PATH, old PATH: what a patch adds and what it changes.
touched() {
    awk '/^--- / { kind = $2 == "/dev/null" ? "new" : "old" }
         /^\+\+\+ / { sub(/^b\//, "", $2); print kind, $2 }' "$1"
}

# check_files NAME: old files are named themselves, new ones lie in a folder that is named, and each
# row that must be is touched.
check_files() {
    rows "$(printf '%s' "$1" | tr _ ' ')" >"$work/rows"
    [ -s "$work/rows" ] || breach "docs/extending.md has no table of files for $1.patch"
    touched "$root/tests/recipes/$1.patch" >"$work/touched"
    awk -v name="$1" -v touched="$work/touched" '
        function folder_of(path) { sub(/[^\/]*$/, "", path); return path }
        function named_folder(path,   f) {
            for (f = folder_of(path); f != ""; f = folder_of(substr(f, 1, length(f) - 1)))
                if (f in row) return f
            return ""
        }
        { row[$2] = $1 }
        END {
            while ((getline line <touched) > 0) {
                split(line, part, " ")
                path = part[2]
                place = path in row ? path : part[1] == "new" ? named_folder(path) : ""
                if (place == "") print name ".patch touches " path ", which its table does not name"
                met[place] = 1
            }
            for (place in row)
                if (row[place] == "must" && !(place in met))
                    print name ".patch does not touch " place ", which its table names"
        }' "$work/rows" | while read -r line; do breach "$line"; done
}

cd -- "$root"
cp -RL ./*.md ./*.sh CMakeLists.txt LICENSE pyproject.toml .ci backends bench cmake docs examples farm \
    include python src tests tools "$copy"
patches=0
for file in tests/recipes/*.patch; do
    name=$(basename "$file" .patch)
    check_files "$name"
    patch -d "$copy" -p1 -s -f --no-backup-if-mismatch -r - <"$file" >"$work/said" 2>&1 ||
        breach "$file no longer fits: $(cat "$work/said")"
    patches=$((patches + 1))
done
# Every section that has a table has a patch.
tables=$(grep -c '^| File | What to add |$' docs/extending.md)
[ "$patches" -eq "$tables" ] || breach "$patches patches for $tables tables of docs/extending.md"
[ ! -s "$bad" ]
