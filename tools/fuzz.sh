#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
#
# tools/fuzz.sh [--same] [SECONDS] [TARGET...]   builds the fuzzers and runs each for SECONDS (30), or
#                                                all of them, as many at a time as there are cores
#
# Inputs that reach new code are kept in build/fuzz/corpus/TARGET and used again. With --same nothing
# is kept or used, and every run makes the same inputs in the same order, a thousand for each of the
# SECONDS unless they are over before: a check that passed on one machine does not fail on the next.
# Fails when a target crashes, leaks, hangs for 25 s on one input, allocates 256 MiB at once or holds
# 1 GiB; what did it is left in build/fuzz/findings, its report is printed. MIR_FUZZ_SCENES names a
# folder of scenes to start from as well.
set -euo pipefail

cd -- "$(dirname -- "$0")/.."
MIR_WANT=check
. tools/setup.sh

same=
[ "${1:-}" != --same ] || { same=1 && shift; }
case ${1:-} in
0) mir_say "0 seconds would be no limit; give the fuzzers 1 or more" && exit 2 ;;
'' | *[!0-9]*) seconds=30 ;;
*) seconds=$1 && shift ;;
esac
all="gltf obj ply exr journal command_line visibility"
targets=${*:-$all}
for name in $targets; do
    case " $all " in
    *" $name "*) ;;
    *) mir_say "There is no fuzzer '$name'; there are: $all" && exit 2 ;;
    esac
done
findings=$PWD/build/fuzz/findings

# Whether a file of that name may be an input of a target; large ones would slow every run down.
scenes_for() {
    case $1 in
    gltf) patterns="-name *.gltf -o -name *.glb" ;;
    obj) patterns="-name *.obj" ;;
    ply) patterns="-name *.ply" ;;
    *) return 0 ;;
    esac
    set -f
    # shellcheck disable=SC2086
    find -L "$MIR_FUZZ_SCENES" -type f -size -16k \( $patterns \)
    set +f
}

# fuzz TARGET: runs it with memory for files in a folder of its own; its log is build/fuzz/TARGET.log.
fuzz() {
    local name=$1 work=build/fuzz/corpus/$1 files options=()
    files=$(mktemp -d -p "$([ -w /dev/shm ] && echo /dev/shm || echo /tmp)")
    [ -z "$same" ] || work=$files/corpus
    mkdir -p "$work" "$findings"
    if [ -n "${MIR_FUZZ_SCENES:-}" ]; then
        scenes_for "$name" | while read -r scene; do cp -n "$scene" "$work"; done
    fi
    local words=tests/fuzz/dictionaries/$name.dict
    [ ! -f "$words" ] || options+=(-dict="$words")
    # Addresses that differ from run to run would show in comparisons and in the order of maps.
    local fixed=()
    if [ -n "$same" ]; then
        options+=(-seed=1 -use_cmp=0 -runs=$((seconds * 1000)))
        ! setarch -R true 2>/dev/null || fixed=(setarch -R)
    fi
    # The parser of arguments prints.
    [ "$name" != command_line ] || options+=(-close_fd_mask=3)
    local status=0 found=()
    [ ! -d "tests/fuzz/found/$name" ] || found+=("tests/fuzz/found/$name")
    # OpenEXR's densest code makes 2^17 bytes of one.
    local longest=16384
    [ "$name" != exr ] || longest=1024
    TMPDIR=$files \
        ASAN_OPTIONS=detect_leaks=1:strict_string_checks=1:detect_stack_use_after_return=1 \
        UBSAN_OPTIONS=print_stacktrace=1:halt_on_error=1 \
        "${fixed[@]}" "build/fuzz/bin/fuzz_$name" -max_total_time="$seconds" -timeout=25 -rss_limit_mb=1024 \
        -malloc_limit_mb=256 -max_len="$longest" -print_final_stats=1 -verbosity=1 \
        -artifact_prefix="$findings/$name-" "${options[@]}" \
        "$work" "tests/fuzz/corpus/$name" "${found[@]}" >"build/fuzz/$name.log" 2>&1 || status=$?
    rm -rf -- "$files"
    return "$status"
}

# Runs, edges that were reached, and findings of the log of a target.
summary() {
    local log=build/fuzz/$1.log runs edges
    runs=$(sed -n 's/^stat::number_of_executed_units: //p' "$log")
    edges=$(sed -n 's/.* cov: \([0-9]*\) .*/\1/p' "$log" | tail -n 1)
    printf '%-14s %12s runs %8s edges   %s\n' "$1" "${runs:-?}" "${edges:-?}" "$2"
}

mir_build fuzz fuzzers
mkdir -p build/fuzz
failed=build/fuzz/failed
rm -f "$failed"
for name in $targets; do
    while [ "$(jobs -rp | wc -l)" -ge "$(mir_jobs)" ]; do wait -n || true; done
    {
        if fuzz "$name"; then
            summary "$name" "no finding"
        else
            summary "$name" "FINDING, see build/fuzz/$name.log"
            sed -n '/ERROR: /,$p' "build/fuzz/$name.log" | head -n 60
            echo "$name" >>"$failed"
        fi
    } &
done
wait
[ ! -s "$failed" ]
