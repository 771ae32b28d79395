#!/bin/sh
# SPDX-License-Identifier: MIT
#
# ./render.sh                  builds the renderer and draws the Cornell box into out/
# ./render.sh SCENE [OPTIONS]  builds the renderer and runs `mir render SCENE [OPTIONS]`
set -eu

root=$(CDPATH='' cd -- "$(dirname -- "$0")" && pwd)
caller=$(pwd)

cd -- "$root"
MIR_WANT=render
. tools/setup.sh
mir_build cpu mir_tool

if [ $# -gt 0 ]; then
    cd -- "$caller"
    exec "$root/build/cpu/bin/mir" render "$@"
fi

mkdir -p out 2>/dev/null || mir_cannot_write out
build/cpu/bin/mir render builtin:cornell-box -o out/cornell-box.exr
echo "The picture is in $root/out/cornell-box.exr, with a preview in $root/out/cornell-box.png"
