#!/bin/sh
# SPDX-License-Identifier: MIT
#
# validate_bill.sh BILL   the validator of the SPDX project (spdx-tools of PyPI, kept below
# ${XDG_CACHE_HOME:-~/.cache}/mir) finds the bill of materials valid, and not a wrong one. Exits with
# 77, and says why, where the validator cannot be had.
set -eu

bill=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

skip() {
    echo "skipped: $*"
    exit 77
}

command -v python3 >/dev/null || skip "python3 is not installed"
version=0.8.5
tools=${XDG_CACHE_HOME:-$HOME/.cache}/mir/spdx-tools-$version-$(python3 -c 'import sys; print(sys.hexversion)')
if [ ! -d "$tools" ]; then
    [ "${MIR_NO_INSTALL:-0}" != 1 ] || skip "spdx-tools is missing, and MIR_NO_INSTALL forbids to fetch it"
    mkdir -p "${tools%/*}"
    python3 -m pip install --quiet --disable-pip-version-check --only-binary :all: \
        --target "$work/tools" "spdx-tools==$version" >"$work/log" 2>&1 ||
        skip "pip could not fetch spdx-tools: $(tail -n 1 "$work/log")"
    mv "$work/tools" "$tools"
fi

validate() { PYTHONPATH=$tools python3 -m spdx_tools.spdx.clitools.pyspdxtools -i "$1"; }

validate "$bill"
sed 's/"licenseConcluded": "MIT"/"licenseConcluded": "no licence"/' "$bill" >"$work/wrong.spdx.json"
if validate "$work/wrong.spdx.json" >/dev/null 2>&1; then
    echo "a bill with a licence that does not exist is taken for valid"
    exit 1
fi
