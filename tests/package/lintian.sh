#!/bin/sh
# SPDX-License-Identifier: MIT
#
# lintian.sh PACKAGES   lintian has no errors and no warnings for Debian's packages of the folder.
# Exits with 77 where it is not installed.
set -eu

command -v lintian >/dev/null || { echo "skipped: lintian is not installed" && exit 77; }
# That tag asks for a number in Debian's tracker of bugs.
exec lintian --allow-root --fail-on error,warning --suppress-tags initial-upload-closes-no-bugs \
    "$1"/*.deb
