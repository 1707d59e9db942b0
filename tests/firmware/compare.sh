#!/usr/bin/env bash
# compare.sh WORK SCENE.h NET.h BOARD... -- solves the scene on this machine and on each emulated board, with the exported
# materials and with reflectances and a lamp chosen now, and compares every integer of the result.
# The seed is printed; URAD_SEED repeats a run. URAD_ERROR (UQ0.32) is where the solves stop, 1 % if not given.
# URAD_BY=table solves by the pose table beside SCENE.h instead of the network, URAD_BY=legacy by the one URAD_LEGACY names.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
work=$1 scene=$2 net=$3
shift 3
"$here/../../firmware_style/ports/build" "$work" "$scene" "$net" host "$@"
work=$(realpath "$work")
seed=${URAD_SEED:-$RANDOM$RANDOM} by=${URAD_BY:-}
echo "seed of the materials: $seed"

"$work/host/solve" - "$work/exported.txt" $by
awk -v seed="$seed" -v error="${URAD_ERROR:-42949673}" '
  BEGIN { srand(seed); print error, 20000 }
  $1 == "material" {
    for (k = 3; k <= 5; ++k) printf "%d ", 29000 * rand()
    for (k = 6; k <= 8; ++k) printf "%d ", $k * (0.25 + 0.75 * rand())
    print ""
  }' "$work/exported.txt" >"$work/chosen_in.txt"
"$work/host/solve" "$work/chosen_in.txt" "$work/chosen.txt" $by
cmp -s "$work/exported.txt" "$work/chosen.txt" && { echo "the chosen materials changed nothing"; exit 1; }

integers=$(cat "$work/exported.txt" "$work/chosen.txt" | awk '$1 == "patch" { n += NF - 2 } END { print n }')
((integers)) || { echo "the host's result holds no patch"; exit 1; }
for board in "$@"; do
  echo "$board:"
  "$work/$board/emulate" solve - "$work/$board/exported.txt" $by
  "$work/$board/emulate" solve "$work/chosen_in.txt" "$work/$board/chosen.txt" $by
  for result in exported chosen; do
    cmp "$work/$result.txt" "$work/$board/$result.txt" || { echo "$board differs from the host ($result materials)"; exit 1; }
  done
  echo "identical: $integers integers on $board and on the host"
done
