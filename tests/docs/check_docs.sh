#!/bin/sh
# SPDX-License-Identifier: MIT
#
# check_docs.sh CHECK ROOT [MIR]   checks the pages of the repository at ROOT against its files and,
# where CHECK needs it, against the program MIR. Prints every mismatch; fails when there is one.
set -eu

check=$1
root=$2
mir=${3:-}

cd -- "$root"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
bad=$work/bad
: >"$bad"

complain() { printf '%s\n' "$*" | tee -a "$bad" >&2; }

pages() { ls ./*.md docs/*.md docs/decisions/*.md examples/*/README.md | sed 's,^\./,,'; }

# Lines of a region between "// region: NAME" and "// endregion: NAME" without their common indent;
# without NAME the whole file after its licence line.
region() {
    if [ -z "$2" ]; then
        sed 1d "$1"
        return
    fi
    awk -v name="$2" '
        { line = $0; sub(/^ */, "", line) }
        line == "// endregion: " name { on = 0; found = 1 }
        on {
            n++; text[n] = $0
            if ($0 != "") {
                match($0, /^ */)
                if (indent == "" || RLENGTH < indent) indent = RLENGTH
            }
        }
        line == "// region: " name { on = 1 }
        END {
            for (i = 1; i <= n; i++) print substr(text[i], indent + 1)
            exit !found
        }' "$1"
}

# Every C++ block is preceded by "<!-- snippet: FILE [REGION] -->" and equals what that names.
check_code() {
    for page in $(pages); do
        awk -v page="$page" -v work="$work" '
            inside && $0 == "```" { inside = 0; close(out); next }
            inside { print >out; next }
            /^```cpp$/ {
                n++; inside = 1
                out = work "/" n ".cpp"
                printf "" >out
                print n, (last ~ /^<!-- snippet: / ? last : "none")
            }
            { last = $0 }' "$page" >"$work/list"
        while read -r n marker; do
            name=$(printf '%s\n' "$marker" |
                sed -n 's/^<!-- snippet: \([^ ]*\) *\([^ ]*\) *-->$/\1 \2/p')
            file=${name%% *}
            if [ -z "$file" ] || [ ! -f "$file" ]; then
                complain "$page: C++ block $n is not quoted from a file ($marker)"
            elif ! region "$file" "${name#* }" >"$work/source"; then
                complain "$page: $file has no region '${name#* }'"
            elif ! diff -u "$work/source" "$work/$n.cpp" >"$work/diff"; then
                complain "$page: C++ block $n differs from $name"
                cat "$work/diff" >&2
            fi
        done <"$work/list"
    done
}

# Headings of a page as the anchors that web viewers make of them.
anchors() {
    awk '/^```/ { code = !code } !code && /^#+ / { sub(/^#+ /, ""); print }' "$1" |
        tr '[:upper:]' '[:lower:]' | sed 's/[^[:alnum:] _-]//g; s/ /-/g'
}

check_links() {
    for page in $(pages); do
        awk '/^```/ { code = !code } !code' "$page" | grep -oE '\]\([^)]+\)' |
            sed 's/^](//; s/)$//' | grep -v '^https\{0,1\}:' | while read -r link; do
                file=${link%%#*}
                target=$page
                [ -z "$file" ] || target=$(dirname "$page")/$file
                if [ ! -e "$target" ]; then
                    complain "$page: link to $link, which does not exist"
                    continue
                fi
                case $link in
                *'#'*)
                    anchors "$target" | grep -qxF -e "${link#*#}" ||
                        complain "$page: link to $link, but no heading gives that anchor"
                    ;;
                esac
            done
    done
    # Pages that nobody can reach are not read.
    for page in docs/*.md; do
        [ "$page" = docs/README.md ] || grep -q "(${page#docs/})" docs/README.md ||
            complain "docs/README.md does not list $page"
    done
    for page in docs/decisions/*.md; do
        [ "$page" = docs/decisions/README.md ] ||
            grep -q "(${page#docs/decisions/})" docs/decisions/README.md ||
            complain "docs/decisions/README.md does not list $page"
    done
    for page in examples/*/README.md; do
        grep -q "(../$page)" docs/embedding.md || complain "docs/embedding.md does not list $page"
    done
}

# Paths in backquotes exist; nothing names a place outside of the repository.
check_paths() {
    for page in $(pages); do
        # shellcheck disable=SC2016
        grep -oE '`(include|src|backends|tools|tests|bench|examples|cmake|python|docs)/[^` ]*`' "$page" |
            tr -d '`' | sort -u | while read -r path; do
                [ -e "$path" ] || complain "$page names $path, which does not exist"
            done
        grep -nE '(^|[^[:alnum:].*/])/(home|root|work|tmp|mnt|Users|usr)/' "$page" |
            while read -r line; do complain "$page: absolute path: $line"; done
    done
    # What the code cites: `docs/limits.md`, `docs/decisions/031`, `docs/method.md, 4.2`.
    code='include src backends tools tests bench examples cmake'
    # shellcheck disable=SC2086
    grep -rhoE 'docs/([a-z_]+\.md|decisions/[0-9]{3})' $code | sort -u | while read -r cited; do
        [ -e "$cited" ] || ls "$cited"-*.md >/dev/null 2>&1 || complain "the code cites $cited, which does not exist"
    done
    grep -rhoE 'docs/method\.md, [0-9]+(\.[0-9]+)?' include src backends tools tests bench examples |
        sort -u | while read -r reference; do
            section=${reference##* }
            grep -qE "^#+ $(printf '%s' "$section" | sed 's/\./\\./') " docs/method.md ||
                complain "the code cites $reference, which is no section"
        done
}

# The rows of a section of docs/command_line.md.
section() {
    awk -v title="## $1" '/^## / { on = $0 == title } on' docs/command_line.md
}

check_options() {
    for command in '' render info export compare denoise devices manual; do
        title=mir${command:+ $command}
        # Without a command --help-all would tell the options of all.
        help=--help${command:+-all}
        # shellcheck disable=SC2086
        "$mir" $command $help | grep -E '^  -' | sed 's/  *[^ -].*//' |
            grep -oE -e '--[a-z][a-z-]*' | sort -u >"$work/help"
        section "$title" | grep -E '^\| `-' | cut -d'|' -f2 | grep -oE -e '--[a-z][a-z-]*' |
            sort -u >"$work/page"
        [ -s "$work/help" ] || complain "$title $help shows no option"
        diff "$work/help" "$work/page" >"$work/diff" ||
            complain "options of '$title' (<) and docs/command_line.md (>) differ:
$(grep '^[<>]' "$work/diff")"
    done
}

# Names that the program writes or accepts, against the page that lists them.
listed() {
    while read -r name; do
        grep -qF -e "\`$name\`" "$1" || complain "$1 does not list $2 '$name'"
    done
}

check_names() {
    "$mir" render builtin:furnace --width 8 --height 8 --vpls 4 --json --quiet -o "$work/a.exr" |
        grep -oE '^ *"[a-z_]+":' | tr -d ' ":' | sort -u >"$work/fields"
    [ -s "$work/fields" ] || complain "mir render --json prints no field"
    "$mir" compare "$work/a.exr" "$work/a.exr" --json --html "$work/a.html" \
        --error "$work/error.png" | grep -oE '^ *"[a-z_]+":' | tr -d ' ":' | sort -u >>"$work/fields"
    listed docs/command_line.md "JSON field" <"$work/fields"
    sed -n 's/.*"\(mir:[a-z_]*\)".*/\1/p' tools/mir/render_attributes.cpp | sort -u |
        listed docs/command_line.md "EXR attribute"
    sed -n 's/^inline constexpr int exit_[a-z_]* = \([0-9]*\);/\1/p' tools/mir/exit_code.hpp |
        while read -r code; do
            section 'Exit codes' | grep -q "^| $code |" ||
                complain "docs/command_line.md does not list exit code $code"
        done
    sed -n 's/^    {"\([a-z-]*\)", .*/\1/p' src/scenes/builtin.cpp >"$work/scenes"
    [ -s "$work/scenes" ] || complain "src/scenes/builtin.cpp lists no scene"
    listed docs/scene_files.md "built-in scene" <"$work/scenes"
}

# Names in backquotes that look like those of code, with an underscore or a capital inside, occur in
# the tree. Not those of options, nor of what other programs call so.
check_words() {
    set -- include src backends tools tests bench examples cmake python docs/snippets CMakeLists.txt
    { grep -rhI . "$@" && find "$@"; } | grep -oE '[A-Za-z_][A-Za-z0-9_]*' | sort -u >"$work/known"
    printf '%s\n' CornellBox libPyImath map_Ks map_Pr | sort -u - "$work/known" >"$work/all"
    for page in $(pages); do
        # shellcheck disable=SC2016
        awk '/^```/ { code = !code } !code' "$page" | grep -oE '`[^`]+`' |
            sed 's/-[-A-Za-z0-9_=]*//g' | grep -oE '[A-Za-z_][A-Za-z0-9_]*' |
            grep -E '_|[a-z][A-Z]' | sort -u | comm -23 - "$work/all" |
            while read -r name; do
                complain "$page names $name, which occurs nowhere in the code"
            done
    done
}

# Lines of prose have at most 120 bytes: all but those of tables and of blocks of code.
check_columns() {
    for page in $(pages); do
        awk '/^ *```/ { code = !code; print ""; next }
             { print code || /^ *\|/ || /^    / || /^<!--/ ? "" : $0 }' "$page" |
            LC_ALL=C grep -nE '.{121}' | cut -d: -f1 | while read -r line; do
                complain "$page:$line: more than 120 bytes"
            done
    done
}

# Words that no technical text of today has. In pages blocks of code, names in backquotes and titles
# in quotes may hold them; in code only comments are looked at. First sentences of
# `///` in public headers have at most 15 words.
check_english() {
    words='anew|likewise|dear(er|est)?|foretold|foretell|but for|in place of|asked for w(as|ere)'
    words="$words|of which|thereof|whereof|therein|wherein|hitherto|henceforth|whilst|amongst|betwixt"
    words="$words|who of|none but|save for|save that|lest|upon|so as to|hence|thence|albeit|shall"
    words="$words|unless told"
    # shellcheck disable=SC2016
    spared='s/`[^`]*`//g; s/"[^"]*"//g; s/(any|all|none|some|most|each|both) of which//g'
    for page in $(pages); do
        awk '/^ *```/ { code = !code; print ""; next } { print code ? "" : $0 }' "$page" |
            sed -E "$spared" | grep -noiwE "$words" | while read -r found; do
                complain "$page:${found%%:*}: \"${found#*:}\" is archaic"
            done
    done
    comments >"$work/comments"
    [ "$(wc -l <"$work/comments")" -gt 3000 ] || complain "comments of the code are not found"
    cut -f 2 "$work/comments" | sed -E "$spared" | grep -noiwE "$words" | while read -r found; do
        line=$(sed -n "${found%%:*}p" "$work/comments" | cut -f 1)
        complain "$line: \"${found#*:}\" in a comment is archaic"
    done
    sed -n 's,^mir/,include/mir/,p' cmake/public_headers.txt | while read -r header; do
        grep -E "^($header|backends/[a-z]*/$header):" "$work/comments"
    done | awk -F '\t' '$3 != "" && $3 > 15 {
        print $1 ": the first sentence has " $3 " words, at most 15 are read"
    }' | while read -r line; do complain "$line"; done
}

# Every comment of the code as a line: FILE:LINE, text, and for those of `///` that stand alone the
# number of words of the first sentence; between tabs. Line ends in a comment are blanks.
comments() {
    find include src backends tools -name '*.[ch]pp' -o -name '*.cu' -o -name '*.cuh' | sort |
        xargs awk '
        function flush(    first) {
            if (text != "" && text !~ /SPDX/) {
                first = text " "
                sub(/\. .*/, "", first)
                if (first ~ /^@/) first = ""
                print place "\t" text "\t" (kind == "///" ? split(first, words, " ") : "")
            }
            text = ""
        }
        FNR == 1 { flush() }
        match($0, /^ *\/\/\/?/) {
            here = $0
            sub(/^ */, "", here)
            new = here ~ /^\/\/\// ? "///" : "//"
            if (new != kind) flush()
            kind = new
            if (here ~ /^\/\/\/</) kind = "///<"
            if (text == "") place = FILENAME ":" FNR
            sub(/^\/\/\/?<? ?/, "", here)
            gsub(/\t/, " ", here)
            text = text == "" ? here : text " " here
            next
        }
        { flush() }
        / \/\/\/?</ {
            text = $0
            sub(/^.* \/\/\/?< ?/, "", text)
            place = FILENAME ":" FNR
            kind = "///<"
            flush()
        }
        END { flush() }'
}

# docs/api.md: 40 names, each in the header that it links to, and the members of RenderSettings with
# their defaults, in the order of the header.
check_api() {
    page=docs/api.md
    sed -n 's/^| \[`\([A-Za-z_:]*\)`\](\.\.\/\([^)]*\)) |.*/\1 \2/p' "$page" >"$work/names"
    [ "$(sort -u "$work/names" | wc -l)" -eq 40 ] ||
        complain "$page names $(sort -u "$work/names" | wc -l) things, its title says 40"
    while read -r name header; do
        grep -qw -- "${name##*:}" "$header" || complain "$page: $header does not name $name"
    done <"$work/names"
    # NAME|DEFAULT; a default that is a list or an expression of its own type keeps its text.
    sed -n '/^struct RenderSettings {/,/void validate/p' include/mir/runtime/settings.hpp |
        sed -n 's/^    \([A-Za-z][^;(]*\((.*)\)\{0,1\}\);.*/\1/p' | grep -v '^void' |
        sed 's/{\(.*\)}$/ = \1/; s/ = \(std\)\{0,1\}[A-Za-z]*::/ = /' |
        sed 's/^.* \([a-z_]*\) = \(.*\)/\1|\2/; s/^[^|]* \([a-z_]*\)$/\1|/' >"$work/members"
    [ "$(wc -l <"$work/members")" -gt 25 ] || complain "the members of RenderSettings are not found"
    sed -n '/^## All members/,$s/^| `\([a-z_]*\)` | \(`\([^`]*\)`\)\{0,1\} *|.*/\1|\3/p' "$page" \
        >"$work/rows"
    diff "$work/members" "$work/rows" >"$work/diff" ||
        complain "members of RenderSettings (<) and $page (>) differ:
$(grep '^[<>]' "$work/diff")"
}

# The library prints nothing and ends no process. Comments may talk of it.
check_silence() {
    grep -rnE '\b(v?f?printf|puts|putchar|perror|abort|exit|_Exit|_exit|quick_exit|terminate) ?\(|std::(cout|cerr|clog)|\bassert\(' \
        include src backends | grep -vE '^[^:]*:[0-9]*: *//' | while read -r line; do
        complain "the library prints or ends the process: $line"
    done
}

# The first two lines of a file of code name the licence.
check_licence() {
    find include src backends tools tests bench examples cmake python docs CMakeLists.txt .ci ./*.sh \
        -type f \
        \( -name '*.[ch]pp' -o -name '*.cu' -o -name '*.cuh' -o -name '*.py' -o -name '*.sh' \
        -o -name '*.cmake' -o -name CMakeLists.txt -o -path '.ci/run' \) >"$work/code"
    [ "$(wc -l <"$work/code")" -gt 100 ] || complain "no code is found"
    while read -r file; do
        head -n 2 "$file" | grep -q 'SPDX-License-Identifier: MIT' ||
            complain "$file does not name its licence"
    done <"$work/code"
    grep -q '^MIT License' LICENSE || complain "LICENSE is not that of MIT"
}

case $check in
code | links | paths | options | names | words | columns | english | api | silence | licence)
    "check_$check"
    ;;
*)
    checks='code|links|paths|options|names|words|columns|english|api|silence|licence'
    echo "usage: check_docs.sh $checks ROOT [MIR]" >&2
    exit 2
    ;;
esac

[ ! -s "$bad" ]
