#!/usr/bin/env bash
# plan.sh PROGRAM WORK -- plans the report's cube, and a louvre with exported visibility, counts their solves on the
# micro:bit, and compares: 15 % at most.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
program=$1 work=$2
root=$here/../..
rm -rf "$work/baked"
mkdir -p "$work"
# planned METHOD SETTING
planned() {
  awk -v method="\"$1\"," -v setting="\"$2\"," '
    $1 == "\"method\":" { inside = $2 == method }
    $1 == "\"setting\":" { $1 = ""; sub(/^ /, ""); if ($0 != setting) inside = 0 }
    inside && $1 == "\"instructions_per_solve\":" { printf "%.0f\n", $2; exit }' "$work/plan.json"
}
counted() { awk -v what="\"$1\":" '$1 == what { for (k = 2; k < NF; ++k) if ($k == "\"mean\":") print $(k + 1) + 0 }' "$work/icount.json"; }
compare() {  # METHOD SETTING LABEL
  p=$(planned "$1" "$2") c=$(counted "$3")
  echo "$1 $2: planned $p, counted $c instructions"
  awk -v p="$p" -v c="$c" 'BEGIN { exit !(p > 0 && c > 0 && p < 1.15 * c && p > 0.85 * c) }' || { echo "off by more than 15 %"; exit 1; }
}
# try SCENE METHODS [OPTION...] -- bakes, plans and counts it.
try() {
  local scene=$1 methods=$2
  shift 2
  rm -rf "$work/baked"
  "$program" --quiet bake "$scene" --method "$methods" --size 16 "$@" -o "$work/baked"
  "$root/bench/icount/run.sh" "$work" "$work/baked/scene.h" "$root/weights/general.h" microbit >/dev/null
}
"$program" --quiet plan cube7 --error 0.01 --json "$work/plan.json" >/dev/null
try cube7 net,table
compare table "" solve_table
compare net "" solve_network
"$program" --quiet plan louvre --subdivide 3 --visibility --error 0.01 --json "$work/plan.json" >/dev/null
try louvre net --subdivide 3 --visibility fractions
compare net "bake --visibility fractions" solve_network
