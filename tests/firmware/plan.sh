#!/usr/bin/env bash
# plan.sh PROGRAM WORK -- plans the report's cube, counts its solves on the micro:bit, and compares: 15 % at most.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
program=$1 work=$2
root=$here/../..
rm -rf "$work/baked"
mkdir -p "$work"
"$program" --quiet bake cube7 --method net,table --size 16 -o "$work/baked"
"$program" --quiet plan cube7 --error 0.01 --json "$work/plan.json" >/dev/null
"$root/bench/icount/run.sh" "$work" "$work/baked/scene.h" "$root/weights/general.h" microbit >/dev/null
planned() {
  awk -v method="\"$1\"," '
    $1 == "\"method\":" { inside = $2 == method }
    $1 == "\"setting\":" && $2 != "\"\"," { inside = 0 }
    inside && $1 == "\"instructions_per_solve\":" { printf "%.0f\n", $2; exit }' "$work/plan.json"
}
counted() { awk -v what="\"$1\":" '$1 == what { for (k = 2; k < NF; ++k) if ($k == "\"mean\":") print $(k + 1) + 0 }' "$work/icount.json"; }
for pair in table:solve_table net:solve_network; do
  p=$(planned "${pair%:*}") c=$(counted "${pair#*:}")
  echo "${pair%:*}: planned $p, counted $c instructions"
  awk -v p="$p" -v c="$c" 'BEGIN { exit !(p > 0 && c > 0 && p < 1.15 * c && p > 0.85 * c) }' || { echo "off by more than 15 %"; exit 1; }
done
