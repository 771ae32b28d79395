#!/bin/sh
# SPDX-License-Identifier: MIT
#
# tools/format.sh           formats every C++ file of the repository
# tools/format.sh --check   changes nothing and fails when a file is not formatted
set -eu

cd -- "$(dirname -- "$0")/.."

formatter=$(command -v clang-format-14 || command -v clang-format) || {
    echo "clang-format is missing; install it (version 14)" >&2
    exit 69
}

case ${1:-} in
--check) mode="--dry-run --Werror" ;;
'') mode=-i ;;
*)
    echo "usage: tools/format.sh [--check]" >&2
    exit 2
    ;;
esac

# Files that are not yet committed count, files that git ignores or that were removed do not.
files() {
    # shellcheck disable=SC2016
    git ls-files -z --cached --others --exclude-standard -- '*.hpp' '*.cpp' '*.cu' '*.cuh' |
        xargs -0 sh -c 'for f; do [ ! -f "$f" ] || printf "%s\0" "$f"; done' sh
}

# shellcheck disable=SC2086
files | xargs -0 -r "$formatter" --style=file $mode
