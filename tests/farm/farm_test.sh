#!/bin/sh
# SPDX-License-Identifier: MIT
#
# farm_test.sh slurm|openjd SOURCE MIR FOLDER: the scripts of farm/ make the bytes of one machine.
# Exit code 77: skipped, for the reason that is printed.
set -eu

which=$1 source=$2 mir=$3 folder=$4
rm -rf "$folder/scenes" "$folder/pictures"
mkdir -p "$folder/scenes" "$folder/pictures"
cd "$folder"

"$mir" export builtin:cornell-box -o scenes/room.1.glb > /dev/null
"$mir" export builtin:sphere -o scenes/room.2.glb > /dev/null
options='--width 40 --height 30 --vpls 32 --backend cpu --quiet --passes 2'
for frame in 1 2; do
    # shellcheck disable=SC2086
    "$mir" render "scenes/room.$frame.glb" $options -o "whole.$frame.exr" > /dev/null
done

# same FRAME PICTURE: fails unless the picture is that of the whole render.
same() {
    cmp "whole.$1.exr" "$2.exr"
    cmp "whole.$1.png" "$2.png"
    sha256sum "$2.exr"
}

slurm() {
    export MIR="$mir" MIR_SHARDS=3 MIR_FRAMES=2
    # In any order, and one task twice.
    for task in 4 1 6 3 2 3 5; do
        # shellcheck disable=SC2086
        SLURM_ARRAY_TASK_ID=$task sh "$source/farm/mir.sbatch" scenes/room.%d.glb \
            pictures/room.%d.exr $options > /dev/null
    done
    sh "$source/farm/mir.sbatch" scenes/room.%d.glb pictures/room.%d.exr > /dev/null
    same 1 pictures/room.1
    same 2 pictures/room.2
}

openjd() {
    if [ ! -x openjd/bin/openjd ]; then
        rm -rf openjd
        if ! python3 -m venv openjd > pip.log 2>&1 ||
            ! timeout 120 openjd/bin/pip install -q openjd-cli==0.8.0 >> pip.log 2>&1; then
            rm -rf openjd
            echo "skipped: openjd-cli of PyPI cannot be installed here ($(tail -n 1 pip.log))"
            exit 77
        fi
    fi
    openjd/bin/openjd run "$source/farm/mir.openjd.yaml" -p "SceneFolder=$folder/scenes" \
        -p 'SceneFile=room.%d.glb' -p Frames=1-2 -p Shards=5 -p "PictureFolder=$folder/pictures" \
        -p "Options=$options" -p "Mir=$mir" > openjd.log 2>&1 || {
        tail -n 40 openjd.log
        exit 1
    }
    same 1 pictures/room.1.1
    same 2 pictures/room.2.2
}

"$which"
