#!/bin/sh
# SPDX-License-Identifier: MIT
#
# What chroot.sh runs inside of an empty Debian: mir installed from its package and from its tarball
# renders the same picture, programs are compiled by pkg-config and CMake, and what is removed
# leaves nothing behind. Exits with 77 where apt cannot fetch anything.
set -eu
export DEBIAN_FRONTEND=noninteractive LC_ALL=C.UTF-8 PATH=/usr/sbin:/usr/bin:/sbin:/bin
# What the machine around it tells compilers means nothing here.
unset CC CXX CFLAGS CXXFLAGS CPPFLAGS LDFLAGS CMAKE_GENERATOR CMAKE_PREFIX_PATH PKG_CONFIG_PATH \
    CMAKE_C_COMPILER_LAUNCHER CMAKE_CXX_COMPILER_LAUNCHER
cd /try

fail() {
    cat log 2>/dev/null
    echo "$*"
    exit 1
}

apt() {
    apt-get -q -y -o Dpkg::Use-Pty=0 -o APT::Keep-Downloaded-Packages=1 -o APT::Sandbox::User=root \
        --no-install-recommends "$@" >log 2>&1
}

# Lists may be older than the mirror's packages. What fails otherwise is a fault of mir's packages.
install() {
    apt install "$@" && return
    grep -q "^E: Failed to fetch" log || fail "apt cannot install $*"
    apt update && apt install "$@" && return
    ! grep -q "^E: Failed to fetch" log || exit 77
    fail "apt cannot install $*"
}

draw() {
    "$1" render builtin:sphere --width 32 --height 32 --vpls 16 -o "$2" >log 2>&1 || fail "$1 fails"
}

install ./mir_*.deb
mir --version
draw mir picture.exr
for file in man/man1/mir.1.gz bash-completion/completions/mir zsh/site-functions/_mir \
    fish/vendor_completions.d/mir.fish; do
    zgrep -q vpls "/usr/share/$file" || fail "/usr/share/$file does not name the options of mir"
done
mkdir unpacked
tar -C unpacked --strip-components=1 -xzf mir-*-linux-*.tar.gz
draw unpacked/bin/mir other.exr
cmp picture.exr other.exr

install ./libmir-dev_*.deb g++ pkg-config cmake make
# shellcheck disable=SC2046
g++ example/main.cpp -o program $(pkg-config --cflags --libs mir-runtime mir-io mir-scenes)
./program furnace.exr
cmake -S example -B build >log 2>&1 || fail "CMake does not find mir"
cmake --build build --target mean_radiance >log 2>&1 || fail "what CMake found does not compile"
build/mean_radiance furnace.exr

dpkg -L mir libmir-dev | grep mir >files
dpkg -P mir libmir-dev >log 2>&1 || fail "removing failed"
while read -r file; do
    [ ! -e "$file" ] || fail "what is removed leaves $file"
done <files
