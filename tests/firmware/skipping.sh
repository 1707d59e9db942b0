#!/usr/bin/env bash
# skipping.sh PROGRAM WORK -- counts rows of factors of scenes with blockers on the micro:bit, with all skips and with none,
# and compares what that saves with what docs/SKIPPING.md records: a tenth less at most.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
program=$1 work=$2
root=$here/../..
mkdir -p "$work"
# recorded COLUMN: of the row that compares both at equal error.
recorded() { awk -F'|' -v column="$1" '$2 ~ /saved at equal error/ { gsub(/[^0-9.]/, "", $column); print $column }' "$root/docs/SKIPPING.md"; }
counted() { awk -v what="\"$1\":" '$1 == what { for (k = 2; k < NF; ++k) if ($k == "\"mean\":") print $(k + 1) + 0 }' "$work/icount.json"; }
column=4  # of cornell, after the name of the row and cube7
for scene in cornell room louvre; do
  "$program" --quiet bake "$scene" --method hemicube:16 --error 0.5 --size 16 -o "$work/$scene"
  PROGRAM=skips SETTING=all "$root/bench/icount/run.sh" "$work" "$work/$scene/scene.h" "$root/weights/general.h" microbit >/dev/null
  on=$(counted on) all=$(counted all) saved=$(recorded $column)
  echo "$scene: $on instructions a row with all skips on, $all with all off, docs/SKIPPING.md: x $saved"
  awk -v on="$on" -v all="$all" -v saved="$saved" 'BEGIN { exit !(on > 0 && saved > 1 && all > 0.9 * saved * on) }' ||
    { echo "the skips save less than recorded, by more than a tenth"; exit 1; }
  ((++column))
done
