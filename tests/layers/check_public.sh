#!/bin/sh
# SPDX-License-Identifier: MIT
#
# check_public.sh ROOT   holds what is public to the list in cmake/public_headers.txt: its headers
# exist and are no details, mir/mir.hpp includes its first part and nothing else, and examples,
# quoted code, pages for embedders and outside projects include no other. Prints every breach; fails
# when there is one.
set -eu
cd -- "$1"
list=cmake/public_headers.txt
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
bad=$work/bad
: >"$bad"

breach() { printf '%s\n' "$*" | tee -a "$bad"; }

grep '^mir/' "$list" >"$work/listed"
[ "$(wc -l <"$work/listed")" -gt 80 ] || breach "$list: its form is another"
[ "$(wc -l <"$work/listed")" -le 150 ] ||
    breach "$list: more than 150 headers; each is read by whoever looks for one"

while read -r header; do
    case $header in */detail/*) breach "$list: $header is a detail" ;; esac
    for base in include backends/cpu/include backends/cuda/include backends/mpi/include; do
        [ ! -f "$base/$header" ] || continue 2
    done
    [ "$header" = mir/version.hpp ] || breach "$list: $header does not exist"
done <"$work/listed"

awk '/^# mir::mir, which/ { on = 1; next } /^$/ { on = 0 } on' "$list" | sort >"$work/core"
sed -n 's/^#include "\(.*\)"$/\1/p' include/mir/mir.hpp | sort >"$work/umbrella"
comm -23 "$work/core" "$work/umbrella" | while read -r header; do
    breach "include/mir/mir.hpp does not include $header"
done
comm -13 "$work/core" "$work/umbrella" | while read -r header; do
    breach "include/mir/mir.hpp includes $header, which $list does not have as its own"
done

# FILE:mir/HEADER of what outside code and its pages include or name.
{
    grep -roE --include='*.[ch]pp' --include='*.cu' '^ *#include ["<]mir/[^">]*' examples \
        docs/snippets tests/package
    # shellcheck disable=SC2016
    grep -oHE '#include ["<]mir/[^">]*|`mir/[a-z_/]*\.[a-z]+|\(\.\./include/mir/[^)]*' README.md docs/api.md \
        docs/checks.md docs/embedding.md docs/getting_started.md examples/*/README.md
} | sed 's#:[^:]*mir/#:mir/#' | sort -u >"$work/used"
[ "$(wc -l <"$work/used")" -gt 60 ] || breach "the search for includes is broken"
while IFS=: read -r file header; do
    [ "$header" = mir/mir.hpp ] || grep -qxF -e "$header" "$work/listed" ||
        breach "$file: names $header, which is not in $list"
done <"$work/used"

[ ! -s "$bad" ]
