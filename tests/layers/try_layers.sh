#!/bin/sh
# SPDX-License-Identifier: MIT
#
# try_layers.sh CHECK ROOT   shows that the check of layers can fail: plants, in a copy, one breach of
# each kind, and wants each to be named.
set -eu
check=$1
root=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd -- "$root"
for folder in include src backends tools examples docs; do cp -R "$folder" "$work"; done
cd -- "$work"

sh "$check" "$work" || { echo "the copy itself has breaches" >&2; exit 1; }

# planted FILE LINE WANTED: the check names WANTED once LINE ends FILE.
planted() {
    cp "$1" kept
    printf '%s\n' "$2" >>"$1"
    if sh "$check" "$work" >said; then
        echo "not found: $2 in $1" >&2
        exit 1
    fi
    grep -q -- "$3" said || { echo "not named: $3; said was:" >&2; cat said >&2; exit 1; }
    cp kept "$1"
}

planted include/mir/core/error.hpp '#include "mir/data/image.hpp"' 'core may not include data'
planted include/mir/accel/kd/kd_node.hpp '#include "mir/accel/wide/wide_node.hpp"' \
    'accel/kd may not include accel/wide'
planted include/mir/reconstruct.hpp '#include "mir/sched/cpu.hpp"' 'may not include sched'
planted include/mir/reconstruct.hpp '#include "mir/render.hpp"' 'may not include render.hpp'
planted include/mir/render.hpp '#include "mir/sched/cpu.hpp"' 'render.hpp may not include sched'
planted include/mir/accel/kd/kd_tree.hpp '#include "mir/accel/exact/detail/thick_triangle.hpp"' \
    'which is for its own folder'
planted tools/mir/main.cpp '#include "mir/film/detail/tap_view.hpp"' 'which is for its own folder'
planted src/scenes/corner.cpp '#include "mir/io/png.hpp"' 'scenes.hpp may not include io'
planted src/io/png.cpp '#include "mir/sched/cpu.hpp"' 'io may not include sched'
planted src/io/png.cpp '#include "mir/scene/detail/far_box.hpp"' 'which is for its own folder'
planted backends/cpu/src/trace_embree.cpp '#include "mir/cuda/register.hpp"' 'cpu may not include cuda'
mkdir include/mir/furniture
echo '#include "mir/core/error.hpp"' >include/mir/furniture/chair.hpp
planted include/mir/furniture/chair.hpp '' 'furniture has no row'
rm -r include/mir/furniture
awk '{ gsub(/\| core, data, concepts \|$/, "| core, data, concepts, runtime |") } 1' docs/architecture.md >other
cp other docs/architecture.md
if sh "$check" "$work" >said; then echo "a row that names one below it was not found" >&2; exit 1; fi
grep -q 'which no row above it is' said
