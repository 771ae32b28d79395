#!/bin/sh
# SPDX-License-Identifier: MIT
#
# check_commands.sh WHICH ROOT MIR BUILD   runs the blocks of commands (```sh) on the pages of the
# repository at ROOT as they are written, with the program MIR of the build folder BUILD. A comment
# of the page before a block says what is different about it:
#
#     <!-- run with: SED COMMANDS -->   changed by sed, to be smaller
#     <!-- run: extended -->            only where WHICH is `extended`, which runs no other
#     <!-- not run: REASON -->          never; options of mir are looked at all the same
#
# WHICH `quick` runs the others and looks at the options of every `mir` and `./render.sh` in blocks
# and in backquotes. The commands of a page share a folder, beside room.obj, build/cpu and examples;
# PREFIX stands for a folder of its own. Prints every mismatch; fails when there is one.
set -eu

which=$1
root=$2
mir=$3
build=$4

cd -- "$root"
root=$(pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
bad=$work/bad
: >"$bad"

complain() { printf '%s\n' "$*" | tee -a "$bad" >&2; }

# Every command on one line: page, line, what to do with its block, command; between tabs.
list_commands() {
    for page in *.md docs/*.md docs/decisions/*.md examples/*/README.md; do
        awk -v page="$page" '
            inside && $0 == "```" { inside = 0; next }
            inside {
                line = $0
                more = sub(/\\$/, "", line)
                command = command line
                if (!more) { printf "%s\t%d\t%s\t%s\n", page, NR, todo, command; command = "" }
                next
            }
            /^```sh$/ {
                inside = 1
                todo = "run"
                if (last ~ /^<!-- (not run: .+|run with: .+|run: extended) -->$/) {
                    todo = last
                    gsub(/^<!-- | -->$/, "", todo)
                }
                next
            }
            /^```/ { code = !code }
            !code && /^    (mir|cmake|\.\/|build|tools)[ \/a-z.]/ {
                printf "%s\t%d\tunmarked\t%s\n", page, NR, $0
            }
            { last = $0 }' "$page"
    done
}

# Options of a command that `mir` or `./render.sh` begins, against the help of the program.
check_options() {
    place=$1
    command=$2
    # shellcheck disable=SC2086
    set -- $command
    case $1 in
    mir) ;;
    ./render.sh) set -- mir render "$@" ;;
    *) return 0 ;;
    esac
    case ${2:-} in
    render | info | export | compare | denoise | devices | manual) sub=$2 ;;
    *) sub= ;;
    esac
    if [ ! -f "$work/help$sub" ]; then
        # shellcheck disable=SC2086
        "$mir" $sub --help-all >"$work/help$sub"
    fi
    for word in "$@"; do
        case $word in
        --[a-z]*) option=${word%%=*} ;;
        -[a-z]) option=$word ;;
        *) continue ;;
        esac
        grep -qE -e "(^|[ ,])$option([ ,=]|\$)" "$work/help$sub" ||
            complain "$place: mir ${sub:-} has no option $option"
    done
}

# Runs a command in the folder of its page.
run_command() {
    place=$1:$2
    folder=$work/$(printf '%s' "$1" | tr '/' '_')
    if [ ! -d "$folder" ]; then
        mkdir -p "$folder/build" "$folder/bin"
        cp examples/first_render/room.* "$folder"
        ln -s "$build" "$folder/build/cpu"
        ln -s "$root/examples" "$folder/examples"
        # What render.sh does behind the build.
        printf '#!/bin/sh\nexec mir render "$@"\n' >"$folder/render.sh"
        chmod +x "$folder/render.sh"
    fi
    command=$(printf '%s\n' "$4" | sed "s,PREFIX\$,$work/prefix,; s,PREFIX ,$work/prefix ,")
    case $3 in
    'run with: '*) command=$(printf '%s\n' "$command" | sed -e "${3#run with: }") ;;
    esac
    (cd "$folder" && PATH=$(dirname "$mir"):$PATH sh -c "$command" >said 2>&1) ||
        complain "$place: $command: $(tail -n 3 "$folder/said")"
}

list_commands >"$work/commands"
tab=$(printf '\t')
while IFS=$tab read -r page line todo command; do
    if [ "$which" = quick ]; then
        check_options "$page:$line" "$command"
    fi
    case $which:$todo in
    quick:unmarked) complain "$page:$line: a command outside of a block \`\`\`sh: $command" ;;
    quick:run | quick:'run with: '* | extended:'run: extended')
        run_command "$page" "$line" "$todo" "$command"
        echo "$page" >>"$work/ran"
        ;;
    esac
done <"$work/commands"
[ -s "$work/ran" ] || complain "no page has a command to run"

if [ "$which" = quick ]; then
    # shellcheck disable=SC2016
    grep -noE '`(mir|\./render\.sh) [^`]*`' *.md docs/*.md docs/decisions/*.md | tr -d '`' >"$work/inline"
    while IFS= read -r found; do
        place=$(printf '%s\n' "$found" | cut -d: -f1,2)
        check_options "$place" "$(printf '%s\n' "$found" | cut -d: -f3-)"
    done <"$work/inline"
    for made in room.exr room.png better.exr reference.exr mir.html comparison.html; do
        [ -s "$work/docs_getting_started.md/$made" ] ||
            complain "docs/getting_started.md: there is no $made"
    done
fi

[ ! -s "$bad" ]
