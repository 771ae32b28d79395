#!/bin/sh
# SPDX-License-Identifier: MIT
#
# check_promises.sh ROOT   checks docs/promises.md of the repository at ROOT: in each row of a table
# the words in quotes behind a file in backquotes are a test of that file (of files that are no C++,
# a part of their text), and a row without a test says "not tested". Prints every mismatch; fails
# when there is one.
set -eu

cd -- "$1"
page=docs/promises.md
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
bad=$work/bad
: >"$bad"

complain() { printf '%s\n' "$*" | tee -a "$bad" >&2; }

# The names of the tests of a C++ file, each in quotes on a line, long ones put together.
tests_of() {
    tr '\n' ' ' <"$1" | sed 's/"  *"//g; s/TEST_CASE( *"/\n"/g' |
        sed -n 's/^\("[^"]*"\).*/\1/p'
}

# FILE TAB WORDS for all words in quotes; ROW TAB TEXT for rows that name no test.
awk '
    /^\| Promise / { table = 1; getline; next }
    !/^\|/ { table = 0 }
    table {
        rest = $0; file = ""; found = 0; rows++
        while (match(rest, /`[^`]*`|"[^"]*"/)) {
            token = substr(rest, RSTART + 1, RLENGTH - 2)
            if (substr(rest, RSTART, 1) == "\"") {
                print file "\t" token
                found = 1
            } else if (token ~ /\//)
                file = token
            rest = substr(rest, RSTART + RLENGTH)
        }
        if (!found && $0 !~ /not tested|\| the same \|/) print "ROW\t" $0
    }
    END { if (rows < 25) print "ROW\t" rows + 0 " rows are too few" }' "$page" >"$work/names"

tab=$(printf '\t')
while IFS=$tab read -r file words; do
    case $file in
    ROW) complain "$page: a row without a test: $words" ;;
    '') complain "$page: no file before \"$words\"" ;;
    *.cpp | *.cu)
        if [ ! -f "$file" ]; then
            complain "$page names $file, which does not exist"
        elif ! tests_of "$file" | grep -qxF -e "\"$words\""; then
            complain "$page: $file has no test \"$words\""
        fi
        ;;
    *)
        grep -qF -e "${words#docs: }" "$file" || complain "$page: $file has no \"$words\""
        ;;
    esac
done <"$work/names"

[ ! -s "$bad" ]
