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

# Of what the build compiles, only files of the repository: generated sources are not ours, and
# compile-fail tests are wrong on purpose.
files() {
    if [ $# -gt 0 ]; then
        printf '%s\n' "$@"
    else
        sed -n 's/^ *"file": "\(.*\)",*$/\1/p' build/tidy/compile_commands.json |
            grep '\.cpp$' | grep -v -e "^$PWD/build/" -e /compile_fail/ | sort -u
    fi
}

count=$(files "$@" | wc -l)
report=build/tidy.txt
if files "$@" | xargs -P "$(mir_jobs)" -n 1 \
    "$tidy" -p build/tidy --quiet --extra-arg=-Wno-unknown-warning-option >"$report" 2>"$log"; then
    echo "clang-tidy: $count files, no findings"
else
    # A header's finding is repeated by every file that includes it.
    grep -h -E ' (error|warning): ' "$report" "$log" | sort -u || tail -n 20 "$log"
    echo "clang-tidy: findings above in the $count files checked; $report shows the lines" >&2
    exit 1
fi
