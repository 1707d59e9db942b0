#!/usr/bin/env bash
# microbit.sh PROGRAM WORK SCENE NET [table] -- the whole way of a scene to the micro:bit: bake it, build the image from the
# exported headers, solve it there and here, compare, and check flash, RAM and what the image holds.
# PROGRAM is `urad`, SCENE a scene it knows, NET a header of weights/. With `table`: by the scene's pose table.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
program=$1 work=$2 scene=$3 net=$4 by=${5:-}
rm -rf "$work/baked"
mkdir -p "$work"
"$program" --quiet bake "$scene" --method "net:$scene${by:+,$by}" -o "$work/baked"
header=$(grep -lE '^static const urad_scene ' "$work"/baked/*.h) || { echo "bake left no scene header"; exit 1; }
URAD_BY=$by "$here/compare.sh" "$work" "$header" "$net" microbit | tee "$work/compare.txt"
stack=$(sed -nE 's/.* stack ([1-9][0-9]*) .*/\1/p' "$work/compare.txt" | sort -n | tail -n 1)
"$here/image.sh" "$work/microbit/solve" "$stack" $((256 * 1024)) $((16 * 1024)) $by
