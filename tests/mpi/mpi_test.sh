#!/bin/sh
# SPDX-License-Identifier: MIT
#
# mpi_test.sh hashes|library|errors MPIEXEC MIR MIR_MPI RANKS FOLDER
# Exit code 77: skipped, for the reason that is printed.
set -eu

which=$1 mpiexec=$2 mir=$3 mir_mpi=$4 ranks=$5 folder=$6
rm -rf "$folder"
mkdir -p "$folder"
cd "$folder"

# More ranks than cores, by whoever runs the tests, in a container or not.
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
export OMPI_MCA_rmaps_base_oversubscribe=1 OMPI_MCA_hwloc_base_binding_policy=none
export OMPI_MCA_btl_vader_single_copy_mechanism=none OMPI_MCA_orte_tmpdir_base="${TMPDIR:-/tmp}"
with_ranks() {
    n=$1
    shift
    "$mpiexec" -n "$n" "$@"
}
if ! with_ranks 2 true >log 2>&1; then
    echo "skipped: ranks cannot be started here ($(tail -n 1 log))"
    exit 77
fi

options='--width 60 --height 70 --backend cpu --threads 1 --quiet'

# same NAME: the picture has the bytes of whole.exr; says their hash.
same() {
    cmp whole.exr "$1.exr"
    cmp whole.png "$1.png"
    echo "$1: $(sha256sum <"$1.exr")"
}

# compare SCENE COUNTS OPTION...: each number of ranks gives the bytes of one process.
compare() {
    scene=$1 counts=$2
    shift 2
    echo "$scene $*"
    # shellcheck disable=SC2086
    "$mir" render "$scene" $options "$@" -o whole.exr >/dev/null
    for n in $counts; do
        # shellcheck disable=SC2086
        with_ranks "$n" "$mir_mpi" render "$scene" $options "$@" -o "$n.exr" >/dev/null
        same "$n"
    done
}

hashes() {
    compare builtin:sphere '1 3 8' --vpls 32
    compare builtin:cornell-box 3 --vpls 32 --passes 2 --aov bounces
    compare builtin:cornell-box 3 --sampler ir --vpls 9000
}

library() { with_ranks 3 "$ranks"; }

# fails CODE WORDS ARGUMENT...: three ranks end with this code, and say this once.
fails() {
    code=$1 words=$2
    shift 2
    got=0
    with_ranks 3 "$mir_mpi" "$@" >out 2>err || got=$?
    [ "$got" = "$code" ] && [ "$(grep -c "^mir: .*$words" err)" = 1 ] ||
        { echo "'$*' ended with $got, not $code and one '$words':"; cat err; exit 1; }
}

errors() {
    echo 'no glTF' >broken.glb
    fails 3 broken.glb render broken.glb
    # shellcheck disable=SC2086
    fails 1 absent render builtin:sphere $options -o absent/picture.exr
    fails 2 'use mir for other commands' devices
    fails 2 'leave --shard out' render builtin:sphere --shard 1/2
    with_ranks 2 "$mir_mpi" --version >out
    [ "$(wc -l <out)" = 1 ]
}

"$which"
