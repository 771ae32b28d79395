#!/bin/sh
# SPDX-License-Identifier: MIT
#
# try_public.sh CHECK ROOT   shows that the check of what is public can fail: plants, in a copy, one
# breach of each kind, and wants each to be named.
set -eu
check=$1
root=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd -- "$root"
mkdir "$work/tests"
for folder in include backends examples docs cmake README.md; do cp -R "$folder" "$work"; done
cp -R tests/package "$work/tests"
cd -- "$work"

sh "$check" "$work" || { echo "the copy itself has breaches" >&2; exit 1; }

# named WANTED FILE: the check names WANTED in FILE as it is now, which is then as it was.
named() {
    if sh "$check" "$work" >said; then
        echo "not found in $2: $1" >&2
        exit 1
    fi
    grep -q -- "$1" said || { echo "not named: $1; said was:" >&2; cat said >&2; exit 1; }
    cp kept "$2"
}

# planted FILE LINE WANTED: the check names WANTED once LINE ends FILE.
planted() {
    cp "$1" kept
    printf '%s\n' "$2" >>"$1"
    named "$3" "$1"
}

fused='#include "mir/kernels/fused.hpp"'
for file in examples/first_render/main.cpp docs/snippets/api.cpp tests/package/two_files/main.cpp \
    README.md docs/embedding.md; do
    planted "$file" "$fused" "$file: names mir/kernels/fused.hpp"
done
# shellcheck disable=SC2016
planted docs/api.md 'See `mir/kernels/fused.hpp`.' 'docs/api.md: names mir/kernels/fused.hpp'
planted include/mir/mir.hpp "$fused" 'mir.hpp includes mir/kernels/fused.hpp'
planted cmake/public_headers.txt mir/core/warmth.hpp 'mir/core/warmth.hpp does not exist'
planted cmake/public_headers.txt mir/io/detail/shown_path.hpp 'shown_path.hpp is a detail'
cp include/mir/mir.hpp kept
sed -i '/reconstruct\.hpp/d' include/mir/mir.hpp
named 'mir.hpp does not include mir/reconstruct.hpp' include/mir/mir.hpp
cp cmake/public_headers.txt kept
yes mir/core/rgb.hpp | head -n 60 >>cmake/public_headers.txt
named 'more than 150 headers' cmake/public_headers.txt
