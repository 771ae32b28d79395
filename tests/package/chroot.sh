#!/bin/sh
# SPDX-License-Identifier: MIT
#
# chroot.sh PACKAGES MIR   installs Debian's packages of the folder PACKAGES into an empty Debian of
# its own, where there is nothing of this machine: mir renders a picture, and a program is compiled
# by pkg-config from libmir-dev. MIR is the repository.
#
# The empty system is made once by mmdebstrap and kept, with the packages fetched for it, below
# ${XDG_CACHE_HOME:-~/.cache}/mir. Exits with 77, and says why, where that cannot be had.
set -eu

packages=$1
sources=$2

skip() {
    echo "skipped: $*"
    exit 77
}

[ "${MIR_TEST_CHROOT:-0}" = 1 ] || skip "MIR_TEST_CHROOT=1 is not set (it takes minutes)"
[ "$(id -u)" = 0 ] || skip "chroots need root"
unshare --mount true 2>/dev/null || skip "this machine allows no mounts"
command -v mmdebstrap >/dev/null || skip "mmdebstrap is not installed"
codename=$(. /etc/os-release && echo "${VERSION_CODENAME:-}")
case $(. /etc/os-release && echo "$ID") in debian) ;; *) skip "this is no Debian" ;; esac

cache=${XDG_CACHE_HOME:-$HOME/.cache}/mir
base=$cache/$codename.tar
mkdir -p "$cache/archives/partial"
if [ ! -f "$base" ]; then
    mmdebstrap --quiet --variant=minbase "$codename" "$base.part" ||
        skip "mmdebstrap could not make a system of $codename"
    mv "$base.part" "$base"
fi

work=$(mktemp -d)
# Mounts live in a namespace that ends before this removes the folder.
trap 'rm -rf --one-file-system "$work"' EXIT
tar -C "$work" -xf "$base" --exclude=./dev
mkdir -p "$work/dev" "$work/try"
cp "$packages"/*.deb "$sources/examples/use_installed/main.cpp" "$work/try"
cp -L /etc/resolv.conf "$work/etc/resolv.conf"
echo force-unsafe-io >"$work/etc/dpkg/dpkg.cfg.d/test"

cat >"$work/try/run" <<'END'
set -eu
export DEBIAN_FRONTEND=noninteractive LC_ALL=C.UTF-8
cd /try
apt-get -qq update >log 2>&1 || { cat log; exit 77; }
install() {
    apt-get -q -y -o Dpkg::Use-Pty=0 -o APT::Keep-Downloaded-Packages=1 -o APT::Sandbox::User=root \
        install --no-install-recommends "$@" >log 2>&1 || { cat log; exit 1; }
}
install ./mir_*.deb
mir --version
mir render builtin:cornell-box --width 32 --height 32 --vpls 16 -o picture.exr
test -s picture.exr
install ./libmir-dev_*.deb g++ pkg-config
g++ main.cpp -o program $(pkg-config --cflags --libs mir-runtime mir-io mir-scenes)
./program furnace.exr
# What is removed leaves nothing behind.
dpkg -P mir libmir-dev >log 2>&1 || { cat log; exit 1; }
test ! -e /usr/include/mir && test ! -e /usr/share/doc/mir
END
# shellcheck disable=SC2016
unshare --mount sh -eu -c '
    mount --bind /dev "$1/dev"
    mount -t proc proc "$1/proc"
    mount --bind "$2/archives" "$1/var/cache/apt/archives"
    chroot "$1" sh /try/run' sh "$work" "$cache" ||
    { [ $? = 77 ] && skip "the Debian mirror does not answer"; exit 1; }
