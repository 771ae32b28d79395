#!/bin/sh
# SPDX-License-Identifier: MIT
#
# ./test.sh [OPTIONS OF CTEST]   builds everything and runs all tests but those labelled `extended`,
#                                which .ci/run adds
set -eu

cd -- "$(dirname -- "$0")"
MIR_WANT=${MIR_WANT:-test}
. tools/setup.sh
mir_build cpu

exec ctest --preset cpu --label-exclude extended --parallel "$(mir_jobs)" "$@"
