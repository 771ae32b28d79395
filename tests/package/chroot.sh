#!/bin/sh
# SPDX-License-Identifier: MIT
#
# chroot.sh PACKAGES MIR   installs Debian's packages of the folder PACKAGES into an empty Debian of
# its own, where there is nothing of this machine, and tries them there (in_chroot.sh). MIR is the
# repository.
#
# mmdebstrap makes the empty system. It is kept for a day below ${XDG_CACHE_HOME:-~/.cache}/mir, as
# are the packages that apt fetches; each run unpacks it anew, into memory. Exits with 77, and says
# why, where that cannot be had.
set -eu

skip() {
    echo "skipped: $*"
    exit 77
}

# Mounts and processes end with these namespaces, whatever happens. Only there is the user root.
if [ -z "${MIR_IN_NAMESPACES:-}" ]; then
    command -v mmdebstrap >/dev/null || skip "mmdebstrap is not installed"
    namespaces="--mount --pid --fork"
    needed="to allow mounts"
    if [ "$(id -u)" != 0 ]; then
        namespaces="--user --map-root-user --map-auto $namespaces"
        needed="root, or user namespaces with uidmap and lines in /etc/subuid and /etc/subgid"
    fi
    # shellcheck disable=SC2086
    unshare $namespaces sh -c 'mount -t tmpfs mir /tmp && mount -t proc proc /proc' 2>/dev/null ||
        skip "a chroot needs this machine $needed"
    # shellcheck disable=SC2086
    MIR_IN_NAMESPACES=1 exec unshare $namespaces sh "$0" "$@"
fi

packages=$1
sources=$2
distribution=$(. /etc/os-release && echo "$ID")
codename=$(. /etc/os-release && echo "${VERSION_CODENAME:-}")
[ "$distribution" = debian ] || skip "this is no Debian"

cache=${XDG_CACHE_HOME:-$HOME/.cache}/mir
base=$cache/$codename.tar
system=$cache/system
mkdir -p "$system"
mount -t tmpfs -o mode=755,size=3g mir "$system"

# The lists of packages stay inside: apt need not fetch them again.
if [ -z "$(find "$base" -mtime -1 2>/dev/null)" ]; then
    rm -rf "$cache/archives"
    TMPDIR=$system mmdebstrap --quiet --mode=root --variant=apt --format=tar \
        --skip=cleanup/apt/lists "$codename" "$base.part" 2>"$system/log" ||
        { cat "$system/log" && skip "mmdebstrap could not make a system of $codename"; }
    mv "$base.part" "$base"
fi
mkdir -p "$cache/archives/partial"

tar -C "$system" -xf "$base" --exclude=./dev
mkdir -p "$system/dev" "$system/try"
cp "$packages"/*.deb "$packages"/mir-*-linux-*.tar.gz "$sources/tests/package/in_chroot.sh" \
    "$system/try"
cp -r "$sources/examples/use_installed" "$system/try/example"
cp -L /etc/resolv.conf "$system/etc/resolv.conf"
echo force-unsafe-io >"$system/etc/dpkg/dpkg.cfg.d/test"
mount --rbind /dev "$system/dev"
mount -t proc proc "$system/proc"
mount --bind "$cache/archives" "$system/var/cache/apt/archives"
chroot "$system" sh /try/in_chroot.sh && exit 0
[ $? = 77 ] && skip "the Debian mirror does not answer"
exit 1
