#!/bin/sh
# SPDX-License-Identifier: MIT
#
# tools/tidy.sh [FILE.cpp...]   runs clang-tidy over the given files, or over all that are built
set -eu

cd -- "$(dirname -- "$0")/.."
MIR_WANT=check
. tools/setup.sh

tidy=$(command -v clang-tidy-14 || command -v clang-tidy) || {
    echo "clang-tidy is missing; install it (version 14)" >&2
    exit 69
}

log=build/tidy.log
mkdir -p build
cmake --preset tidy >"$log" 2>&1 || {
    tail -n 20 "$log" >&2
    exit 1
}

# All: in units that are quicker to read, see lint_units.py.
if [ $# -gt 0 ]; then
    commands=build/tidy
    list=$(printf '%s\n' "$@")
else
    commands=build/tidy/units
    list=$(python3 tools/lint_units.py build/tidy/compile_commands.json "$commands")
fi

count=$(printf '%s\n' "$list" | wc -l)
report=build/tidy.txt
if printf '%s\n' "$list" | xargs -P "$(mir_jobs)" -n 1 \
    "$tidy" -p "$commands" --quiet --extra-arg=-Wno-unknown-warning-option >"$report" 2>"$log"; then
    echo "clang-tidy: $count files, no findings"
else
    # A header's finding is repeated by every file that includes it.
    grep -h -E ' (error|warning): ' "$report" "$log" | sort -u || tail -n 20 "$log"
    echo "clang-tidy: findings above in the $count files checked; $report shows the lines" >&2
    exit 1
fi
