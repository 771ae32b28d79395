#!/bin/sh
# SPDX-License-Identifier: MIT
#
# ./test.sh [OPTIONS OF CTEST]   builds everything and runs all tests
set -eu

cd -- "$(dirname -- "$0")"
MIR_WANT=${MIR_WANT:-test}
. tools/setup.sh
mir_build cpu

exec ctest --preset cpu --parallel "$(mir_jobs)" "$@"
