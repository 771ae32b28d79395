#!/bin/sh
# SPDX-License-Identifier: MIT
#
# python/check.sh [extended]   builds the wheel, installs it into an empty virtual environment and runs
#                              python/tests; `extended` adds every built-in scene and the packages of
#                              neighbours
#
# What it downloads stays in build/wheels. Skipped, with a reason, where PyPI cannot be reached before
# that.
set -eu

cd -- "$(dirname -- "$0")/.."
kind=${1:-usual}
wheels=build/wheels/$kind
log=build/python.log
mkdir -p "$wheels" build/dist

say() { printf '%s\n' "python: $*" >&2; }
quiet() {
    "$@" >>"$log" 2>&1 && return
    tail -n 30 "$log" >&2
    say "'$*' failed; the whole log is in $log"
    exit 1
}
: >"$log"

# Packages by their names in python/requirements.txt, and those of neighbours.
list=python/requirements.txt
[ "$kind" != extended ] || list=python/requirements-extended.txt
if [ -z "$(find "$wheels/complete" -newer python/requirements.txt -newer "$list" 2>/dev/null)" ]; then
    if ! python3 -m pip download --disable-pip-version-check --only-binary :all: -r "$list" \
        -d "$wheels" >>"$log" 2>&1; then
        say "skipped: PyPI cannot be reached, or lacks a package of $list (see $log)"
        exit 0
    fi
    touch "$wheels/complete"
fi

# environment FOLDER PACKAGE...: a virtual environment that holds these and what they need.
environment() {
    folder=$1
    shift
    rm -rf "$folder"
    quiet python3 -m venv "$folder"
    quiet "$folder/bin/python" -m pip install --disable-pip-version-check --no-index \
        --find-links "$wheels" --find-links build/dist "$@"
}

# The tools of the build stay where they are, so that what did not change is not compiled again.
tools=build/wheels/tools
if [ -z "$(find "$tools/complete" -newer python/requirements.txt 2>/dev/null)" ]; then
    environment "$tools" scikit-build-core nanobind
    touch "$tools/complete"
fi
rm -f build/dist/*.whl
quiet "$tools/bin/python" -m pip wheel --disable-pip-version-check --no-deps --no-build-isolation \
    -w build/dist .
environment build/venv -r "$list" mir

marks='not extended'
[ "$kind" != extended ] || marks=
exec build/venv/bin/python -m pytest -q -rs -m "$marks"
