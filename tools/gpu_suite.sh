#!/bin/sh
# SPDX-License-Identifier: MIT
#
# tools/gpu_suite.sh [BUILD]   runs the tests that need a GPU, then again under compute-sanitizer
#
# BUILD is the folder of a finished build of the preset `cuda` (default build/cuda).
set -eu

cd -- "$(dirname -- "$0")/.."
build=${1:-build/cuda}

ctest --test-dir "$build" -L gpu --no-tests=error --output-on-failure

# Left out: a kernel that fails on purpose, and one whose time is measured. API errors are part of
# the tests, which refuse memory and devices that do not exist.
for tool in memcheck racecheck initcheck; do
    leaks=
    [ "$tool" != memcheck ] || leaks="--leak-check full"
    echo "== $tool"
    # shellcheck disable=SC2086
    compute-sanitizer --tool "$tool" $leaks --report-api-errors no --error-exitcode 1 \
        "$build/bin/test_cuda" '~[kernel_failure]~[clock]'
done
