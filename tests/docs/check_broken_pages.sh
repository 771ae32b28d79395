#!/bin/sh
# SPDX-License-Identifier: MIT
#
# check_broken_pages.sh ROOT   check_docs.sh has to notice long lines and archaic words in prose, and
# to leave tables, code and names alone.
set -eu

root=$(cd -- "$1" && pwd)
here=$(cd -- "$(dirname -- "$0")" && pwd)
copy=$(mktemp -d)
trap 'rm -rf "$copy"' EXIT
mkdir -p "$copy/docs/decisions" "$copy/examples/one"
for folder in backends cmake include src tools; do cp -R "$root/$folder" "$copy"; done
echo '# Page' | tee "$copy/README.md" "$copy/docs/limits.md" "$copy/docs/decisions/README.md" \
    >"$copy/examples/one/README.md"

# try CHECK refused|accepted PAGE TEXT: what CHECK says of a page that ends with TEXT.
try() {
    cp "$copy/$3" "$copy/before"
    printf '%s\n' "$4" >>"$copy/$3"
    if sh "$here/check_docs.sh" "$1" "$copy" 2>/dev/null; then said=accepted; else said=refused; fi
    cp "$copy/before" "$copy/$3"
    if [ "$said" != "$2" ]; then
        echo "$1: $said, not $2: $4" >&2
        exit 1
    fi
}

ten='ten words '
long=$ten$ten$ten$ten$ten$ten$ten$ten$ten$ten$ten$ten
try columns accepted docs/limits.md "$long"
for page in README.md docs/limits.md docs/decisions/README.md examples/one/README.md; do
    try columns refused "$page" "${long}x"
done
try columns accepted docs/limits.md "${long%ds }…"
try columns refused docs/limits.md "${long% }…"
try columns accepted docs/limits.md "| $long |"
try columns accepted docs/limits.md "    $long"
try columns accepted docs/limits.md "$(printf '```sh\n%sx\n```' "$long")"
try english refused docs/limits.md 'It is computed anew.'
try english refused docs/decisions/README.md 'Pairs, of which two are clear.'
try english accepted docs/limits.md 'Pairs, any of which may be clear.'
# shellcheck disable=SC2016
try english accepted docs/limits.md 'The test "trees are built anew" runs `anew`.'
try english accepted docs/limits.md "$(printf '```sh\nmir anew\n```')"
