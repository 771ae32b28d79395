#!/bin/sh
# SPDX-License-Identifier: MIT
#
# check_layers.sh ROOT   holds every include of the library to the table in docs/architecture.md: a
# folder includes what its row names, a row names what stands above it, and a header in a detail/ is
# included from its own folder alone. Prints every breach; fails when there is one.
set -eu
cd -- "$1"

# FILE:#include "mir/OTHER", FILE relative to the folder that holds mir/.
includes() {
    for base in include backends/cpu/include backends/cuda/include backends/mpi/include; do
        [ ! -d "$base" ] || (cd "$base" && grep -ro --include='*.hpp' --include='*.cuh' \
            '^#include "mir/[^"]*"' mir)
    done
    # Sources of a component count as its folder.
    for component in cpu cuda mpi; do
        [ ! -d "backends/$component/src" ] || (cd "backends/$component/src" &&
            grep -ro '^#include "mir/[^"]*"' . | sed "s#^\./#mir/$component/#")
    done
    # What is compiled of a row counts as that row.
    (cd src && grep -ro '^#include "mir/[^"]*"' denoise io render runtime scenes | sed 's#^#mir/#')
    grep -ro '^#include "mir/[^"]*detail/[^"]*"' tools/mir examples docs |
        sed 's#^#outside/#' || true
}

includes | awk -v table=docs/architecture.md '
    # The folder of a header: the longest row that it lies in; headers at the root are *.hpp unless a
    # row names them.
    function folder_of(path,   parts, n) {
        n = split(path, parts, "/")
        if (path == "mir.hpp" || path == "version.hpp") return path
        if (n == 1) return (path in row) ? path : "*.hpp"
        if ((parts[1] ".hpp") in row) return parts[1] ".hpp"
        if ((parts[1] "/" parts[2]) in row) return parts[1] "/" parts[2]
        return parts[1]
    }
    function breach(text) { print text; breaches++ }
    BEGIN {
        FS = "|"
        while ((getline line < table) > 0) {
            if (line !~ /^\| `[a-z\/*.]+` \|/) { if (rows && line !~ /^\|/) break; continue }
            split(line, cell, "|")
            name = cell[2]; gsub(/[` ]/, "", name); sub(/\/$/, "", name)
            row[name] = ++rows
            wanted = cell[4]; gsub(/ /, "", wanted)
            if (wanted == "allabove") { for (above in row) if (row[above] < rows) may[name, above] = 1; continue }
            n = split(wanted, names, ",")
            for (i = 1; i <= n; i++) {
                if (!(names[i] in row)) breach(table ": " name " may include " names[i] ", which no row above it is")
                may[name, names[i]] = 1
            }
        }
        if (rows < 20) breach(table ": " rows " rows of folders were found; its form is another")
        FS = ":"
    }
    {
        includes++
        from = $1; to = $2
        sub(/^#include "mir\//, "", to); sub(/"$/, "", to)
        if (from ~ /^outside\//) { sub(/^outside\//, "", from); breach(from ": includes mir/" to ", which is for its own folder"); next }
        sub(/^mir\//, "", from)
        if (from == "mir.hpp" || to == "version.hpp") next
        a = folder_of(from); b = folder_of(to)
        if (!(a in row)) breach("mir/" from ": " a " has no row in " table)
        if (a == b) next
        if (!((a, b) in may)) breach("mir/" from ": includes mir/" to ", but " a " may not include " b)
        if (to ~ /detail\//) breach("mir/" from ": includes mir/" to ", which is for its own folder")
    }
    END {
        if (includes < 1000) breach(includes " includes were found; the search for them is broken")
        exit breaches > 0
    }'
