#!/bin/sh
# SPDX-License-Identifier: MIT
#
# check_broken_promises.sh ROOT   check_promises.sh has to notice each of some mistakes in the page.
set -eu

root=$(cd -- "$1" && pwd)
here=$(cd -- "$(dirname -- "$0")" && pwd)
copy=$(mktemp -d)
trap 'rm -rf "$copy"' EXIT
mkdir "$copy/docs"
ln -s "$root/tests" "$root/tools" "$root/python" "$copy"

# try SED: whether the page that SED changes is refused.
try() {
    sed "$1" "$root/docs/promises.md" >"$copy/docs/promises.md"
    if cmp -s "$copy/docs/promises.md" "$root/docs/promises.md"; then
        echo "nothing changes by: $1" >&2
        exit 1
    fi
    if sh "$here/check_promises.sh" "$copy" 2>/dev/null; then
        echo "not noticed: $1" >&2
        exit 1
    fi
}

cp "$root/docs/promises.md" "$copy/docs"
sh "$here/check_promises.sh" "$copy"
try 's/"A wrong bit is seen in the image"/"A wrong bit is seen"/'
try 's/sched\/reshade_test/sched\/reshaded_test/'
try 's/"the core needs GLM alone"/"the core needs nothing"/'
try 's/"image_(tile/"images_(tile/'
try 's/: not tested: Embree/: Embree/; s/| not tested |/| tested |/'
try '/^| [A-Z].*`tests\/shaft/,$d'
