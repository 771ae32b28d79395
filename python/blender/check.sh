#!/bin/sh
# SPDX-License-Identifier: MIT
#
# python/blender/check.sh [CHECK...]   packs the add-on, installs it and renders with it in bpy of
#                                      PyPI and in the installed Blender; `all`: everything
#
# CHECK: materials, engine, views, preview, builds, lamps, pictures. Without any: the first four.
# bpy lies in ~/.cache/mir/bpy once it was downloaded (350 MB); MIR_BLENDER names another Blender
# than `blender`. Its 3D view is checked where there is xvfb-run. Each host that cannot be had is
# skipped, with a reason.
set -eu

here=$(cd -- "$(dirname -- "$0")" && pwd)
root=$(cd -- "$here/../.." && pwd)
cache=${XDG_CACHE_HOME:-$HOME/.cache}/mir/bpy
bpy_version=5.0.1
out=$root/build/blender
log=$out/check.log
[ $# -gt 0 ] || set -- materials engine views preview
[ "$1" != all ] || set -- materials engine views preview builds lamps pictures

say() { printf '%s\n' "blender: $*" >&2; }
rm -rf "$out"
mkdir -p "$out"
wheel=$(find "$root/build/dist/whole" -name 'mir-*-cp311-*.whl' 2>/dev/null | head -n 1)
if [ -z "$wheel" ]; then
    say "skipped: build/dist/whole has no wheel of Python 3.11 (python/wheel.sh makes one)"
    exit 0
fi
sh "$here/package.sh" "$wheel" "$out/zip" >"$log"
python3 -m zipfile -e "$out"/zip/*-blender3.zip "$out/old"
failed=0

# checked NAME COMMAND...: runs the checks in this Blender and shows what they say.
checked() {
    name=$1
    shift
    if MIR_CHECK_FOLDER=$out/$name MIR_CHECK_ADDON=$out/old "$@" >"$out/$name.log" 2>&1; then
        grep -E 'cancellations|edits|restarts|: [0-9]+ failures' "$out/$name.log" || true
    else
        grep -E 'FAILED|Error|failures' "$out/$name.log" >&2 || tail -n 20 "$out/$name.log" >&2
        say "failed in $name; the whole log is in $out/$name.log"
        failed=1
    fi
}

# bpy_is_here: its environment is complete, or becomes so.
bpy_is_here() {
    [ ! -f "$cache/complete-$bpy_version" ] || return 0
    rm -rf "$cache"
    python3 -m venv "$cache" >>"$log" 2>&1 &&
        "$cache/bin/python" -m pip install --disable-pip-version-check --only-binary :all: \
            "bpy==$bpy_version" >>"$log" 2>&1 && touch "$cache/complete-$bpy_version"
}

checked wheel python3 "$here/tests/refuse_wheel.py"
if ! python3 -c 'import sys; sys.exit(sys.version_info[:2] != (3, 11))'; then
    say "bpy $bpy_version skipped: it needs Python 3.11"
elif ! bpy_is_here; then
    say "bpy $bpy_version skipped: PyPI cannot be reached, or lacks it (see $log)"
elif ! missing=$("$cache/bin/python" -c 'import bpy' 2>&1); then
    say "bpy $bpy_version skipped: a library of the system is missing ($(echo "$missing" | tail -n 1))"
else
    checked extension env BLENDER_USER_RESOURCES="$out/resources" "$cache/bin/python" \
        "$here/tests/install_extension.py" "$(find "$out/zip" -name '*.zip' ! -name '*blender3*')"
    checked bpy "$cache/bin/python" "$here/tests/run.py" "$@"
fi

blender=${MIR_BLENDER:-blender}
if command -v "$blender" >/dev/null 2>&1; then
    checked blender "$blender" --background --factory-startup --python-exit-code 1 \
        --python "$here/tests/run.py" -- "$@"
    if command -v xvfb-run >/dev/null 2>&1; then
        checked viewport env LIBGL_ALWAYS_SOFTWARE=1 xvfb-run --auto-servernum "$blender" \
            --factory-startup --window-geometry 0 0 640 480 --python "$here/tests/show_viewport.py"
    else
        say "the 3D view skipped: xvfb-run is not installed (apt-get install xvfb)"
    fi
else
    say "Blender skipped: '$blender' is not installed (apt-get install blender python3-numpy)"
fi
exit "$failed"
