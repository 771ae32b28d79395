#!/bin/sh
# SPDX-License-Identifier: MIT
#
# tools/check_headers.sh       compiles a third of the headers that users include, each by itself
# tools/check_headers.sh all   compiles all of them
#
# All of them take two cores five minutes. Which third it is goes by the time of the last commit, so
# that commits take turns.
set -eu

cd -- "$(dirname -- "$0")/.."
MIR_WANT=check
. tools/setup.sh

case ${1:-} in
all) share=1 ;;
'') share=3 ;;
*)
    echo "usage: tools/check_headers.sh [all]" >&2
    exit 2
    ;;
esac

[ -f build/cpu/build.ninja ] || mir_configure cpu >build/cpu.log 2>&1 || {
    tail -n 20 build/cpu.log >&2
    exit 1
}
objects=$(ninja -C build/cpu -t targets all |
    sed -n 's/^\(.*_verify_interface_header_sets\/mir\/.*\.o\): .*/\1/p' |
    awk -v share="$share" -v turn="$(mir_turn "$share")" 'NR % share == turn')
[ -n "$objects" ] || {
    echo "build/cpu checks no headers; remove it and try again" >&2
    exit 1
}
# shellcheck disable=SC2086
mir_build cpu $objects
echo "$(echo "$objects" | wc -l) headers compile by themselves"
