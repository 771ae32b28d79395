#!/bin/sh
# SPDX-License-Identifier: MIT
#
# python/blender/package.sh [WHEEL [FOLDER]]   packs the add-on with its wheel
#
# FOLDER/mir_render-VERSION.zip is for Blender 4.2 and newer, FOLDER/mir_render-VERSION-blender3.zip
# for Debian's 3.4.
#
# WHEEL (build/dist/whole/mir-*.whl) is what python/wheel.sh makes. FOLDER: build/dist/blender.
set -eu

here=$(cd -- "$(dirname -- "$0")" && pwd)
root=$(cd -- "$here/../.." && pwd)
wheel=${1:-$(find "$root/build/dist/whole" -name 'mir-*.whl' 2>/dev/null | head -n 1)}
out=${2:-$root/build/dist/blender}
most=25000000

say() { printf '%s\n' "package.sh: $*" >&2; }
[ -f "$wheel" ] || {
    say "there is no wheel; make one with python/wheel.sh"
    exit 1
}
name=$(basename "$wheel")
case $name in
*-cp311-cp311-*linux*_x86_64.whl) ;;
*)
    say "$name does not fit Blender 3.4 to 5.0: give a wheel of Python 3.11 for Linux x86-64"
    exit 1
    ;;
esac
version=$(echo "$name" | cut -d- -f2)
mkdir -p "$out"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# zip_folder FOLDER FILE: FOLDER's contents as FILE, the same bytes each time.
zip_folder() {
    python3 - "$1" "$2" <<'PYTHON'
import pathlib, sys, zipfile
folder = pathlib.Path(sys.argv[1])
with zipfile.ZipFile(sys.argv[2], "w", zipfile.ZIP_DEFLATED) as archive:
    for path in sorted(p for p in folder.rglob("*") if p.is_file()):
        info = zipfile.ZipInfo(str(path.relative_to(folder)))
        info.external_attr = 0o644 << 16
        info.compress_type = zipfile.ZIP_DEFLATED
        archive.writestr(info, path.read_bytes())
PYTHON
    size=$(wc -c <"$2")
    if [ "$size" -ge "$most" ]; then
        say "$2 has $size bytes, more than $most: the wheel is too large"
        exit 1
    fi
    echo "$2"
}

new=$work/new
mkdir -p "$new/wheels"
cp "$here"/mir_render/*.py "$root/LICENSE" "$new"
cp "$wheel" "$new/wheels"
sed -e "s/@version@/$version/" -e "s/@wheel@/$name/" "$here/mir_render/blender_manifest.toml" \
    >"$new/blender_manifest.toml"
zip_folder "$new" "$out/mir_render-$version.zip"

old=$work/old/mir_render
mkdir -p "$old/unpacked_wheel"
cp "$here"/mir_render/*.py "$root/LICENSE" "$old"
python3 -m zipfile -e "$wheel" "$old/unpacked_wheel"
zip_folder "$work/old" "$out/mir_render-$version-blender3.zip"
