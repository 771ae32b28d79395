# SPDX-License-Identifier: MIT
# shellcheck shell=sh
#
# What render.sh, test.sh and .ci/run share: packages, number of jobs, build with a log. Sourced
# from the repository root; the wish comes in MIR_WANT (render, test or check), because dash passes
# no arguments to a sourced file. MIR_NO_INSTALL=1 never installs anything.

mir_say() { printf '%s\n' "$*" >&2; }

# The tree may lie on a medium that is read only, or belong to somebody else.
mir_cannot_write() {
    mir_say "$(pwd)/$1 cannot be written (what is built and drawn goes there); copy the tree to a" \
        "folder of your own"
    exit 1
}

mir_packages() {
    echo "g++ cmake ninja-build libembree-dev libtbb-dev libglm-dev libopenexr-dev libpng-dev" \
        "zlib1g-dev libcli11-dev nlohmann-json3-dev libtinygltf-dev libtinyobjloader-dev"
    case ${MIR_WANT:-render} in
    test | check) echo "catch2 libbenchmark-dev patch" ;;
    esac
    case ${MIR_WANT:-render} in
    check) echo "git clang libclang-rt-dev libstb-dev clang-format clang-tidy python3 python3-pip" \
        "python3-venv python3-dev" \
        "doxygen mmdebstrap lintian libopenmpi-dev openmpi-bin python3-mpi4py" ;;
    esac
}

# The same list for systems without dpkg.
mir_libraries() {
    printf '%s' "a C++20 compiler, CMake 3.25, Ninja, Embree 3.12 or 4, oneTBB, GLM, OpenEXR 3.1, " \
        "libpng, zlib, CLI11, nlohmann-json, tinygltf, tinyobjloader"
    case ${MIR_WANT:-render} in
    test | check) printf ', Catch2, Google Benchmark, patch' ;;
    esac
    case ${MIR_WANT:-render} in
    check) printf ', git, clang, stb, clang-format, clang-tidy, Python 3 with pip, Doxygen, mmdebstrap, lintian, Open MPI, mpi4py' ;;
    esac
}

mir_missing() {
    missing=
    for package in $(mir_packages); do
        state=$(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null) || state=
        [ "$state" = installed ] || missing="$missing $package"
    done
    echo "${missing# }"
}

# Runs apt-get as $1 ("" or "sudo -n") for the packages that follow.
mir_apt() {
    as=$1
    shift
    # shellcheck disable=SC2086
    $as env DEBIAN_FRONTEND=noninteractive apt-get -q update >&2 &&
        $as env DEBIAN_FRONTEND=noninteractive \
            apt-get -q -y install --no-install-recommends "$@" >&2
}

mir_setup() {
    if ! command -v dpkg-query >/dev/null 2>&1; then
        mir_say "Not a Debian system; this needs $(mir_libraries)"
        return 0
    fi
    missing=$(mir_missing)
    [ -n "$missing" ] || return 0
    if [ "${MIR_NO_INSTALL:-0}" != 1 ]; then
        if [ "$(id -u)" = 0 ]; then
            as=
        elif command -v sudo >/dev/null 2>&1 && sudo -n true 2>/dev/null; then
            as="sudo -n"
        else
            as=nobody
        fi
        if [ "$as" != nobody ]; then
            mir_say "Installing: $missing"
            # shellcheck disable=SC2086
            mir_apt "$as" $missing && return 0
            mir_say "The packages could not be installed (apt-get failed, see above)."
            exit 69
        fi
    fi
    mir_say "Packages are missing and nothing was changed. An administrator can install them with:"
    mir_say "    apt-get update && apt-get install --no-install-recommends $missing"
    exit 69
}

# All cores, but no more than one compiler for 2 GiB of memory.
mir_jobs() {
    jobs=$(getconf _NPROCESSORS_ONLN 2>/dev/null) || jobs=1
    kib=$(awk '/^MemTotal:/ { print $2 }' /proc/meminfo 2>/dev/null) || kib=
    if [ -n "$kib" ]; then
        fit=$((kib / 2097152))
        [ "$fit" -ge 1 ] || fit=1
        [ "$jobs" -le "$fit" ] || jobs=$fit
    fi
    echo "$jobs"
}

# mir_turn N: 0 to N - 1, another from commit to commit, for checks that commits take turns with.
mir_turn() {
    turn=$(git log -1 --format=%ct 2>/dev/null) || turn=0
    echo $((turn % $1))
}

# Tests want packages that rendering does without: they are left out of a build folder that
# render.sh makes, and taken in by the others.
mir_configure() {
    if [ "$1" = fuzz ]; then
        cmake --preset "$1"
    elif [ "${MIR_WANT:-render}" != render ]; then
        cmake --preset "$1" -DMIR_BUILD_TESTS=ON
    elif [ -f "build/$1/CMakeCache.txt" ]; then
        cmake --preset "$1"
    else
        cmake --preset "$1" -DMIR_BUILD_TESTS=OFF
    fi
}

# mir_build PRESET [TARGET...]: configures and builds. The output goes to build/PRESET.log; its last
# lines are shown when something fails.
mir_build() {
    preset=$1
    shift
    log=build/$preset.log
    # In a shell of its own: one that cannot open the log would end this one with words of its own.
    if ! mkdir -p build 2>/dev/null || ! (: >>"$log") 2>/dev/null; then mir_cannot_write build; fi
    mir_say "Building preset $preset with $(mir_jobs) jobs (log: $log)"
    [ -f "build/$preset/build.ninja" ] ||
        mir_say "The first time takes some minutes; the end of the log tells how far it is."
    # shellcheck disable=SC2086
    if mir_configure "$preset" >"$log" 2>&1 &&
        cmake --build --preset "$preset" --parallel "$(mir_jobs)" ${1:+--target "$@"} >>"$log" 2>&1
    then
        return 0
    fi
    tail -n 20 "$log" >&2
    mir_say "The build of preset $preset failed; the whole log is in $log"
    return 1
}

# axe-core judges whether everybody can read the reports; Debian does not have it. Without it that test
# is skipped, which it says.
mir_fetch_axe() {
    axe=build/axe
    [ -z "$(find "$axe/axe.min.js" -newer tools/axe.txt 2>/dev/null)" ] || return 0
    [ "${MIR_NO_INSTALL:-0}" != 1 ] || return 0
    rm -rf "$axe"
    if python3 -m pip download --quiet --disable-pip-version-check --no-deps --only-binary :all: \
        --require-hashes -r tools/axe.txt -d "$axe" >&2 &&
        python3 -m zipfile -e "$axe"/*.whl "$axe/wheel" &&
        cp "$axe/wheel/axe_playwright_python/axe.min.js" "$axe/axe.min.js"; then
        return 0
    fi
    mir_say "axe-core could not be fetched; reports are not checked for accessibility"
}

mir_setup
[ "${MIR_WANT:-render}" != check ] || mir_fetch_axe
