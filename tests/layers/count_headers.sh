#!/bin/sh
# SPDX-License-Identifier: MIT
#
# count_headers.sh CXX ROOT HEADER LIMIT   counts the other headers of mir that mir/HEADER pulls, and
# fails when there are more than LIMIT. What a program includes first decides how long it compiles.
set -eu
cxx=$1
header=$3
limit=$4
cd -- "$2"

# Headers of packages may be absent (-MG): they do not count.
pulled=$("$cxx" -std=gnu++20 -x c++ -MM -MG -I include "include/mir/$header" | tr ' ' '\n' |
    grep -o 'include/mir/.*\.hpp$' | sort -u | grep -vx "include/mir/$header") ||
    { echo "the headers that mir/$header pulls were not found" >&2; exit 1; }
count=$(printf '%s\n' "$pulled" | wc -l)
echo "mir/$header pulls $count other headers of mir, $limit are allowed"
[ "$count" -le "$limit" ] || { printf '%s\n' "$pulled"; exit 1; }
