#!/usr/bin/env bash
# measure.sh WORK SEED... -- what `urad plan` predicts, measured: for each seed a scene of bench/plan/random_scene.hpp, its
# rows and a solve counted on a Cortex-M0 (WORK/SEED/costs.txt: label, tab, instructions), and every method's light
# against the exact one (WORK/SEED/METHOD.json). With URAD_SOLVES=1 also whole solves by each method (solves.txt). Needs
# build/urad and build/urad_plan_fit.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$here/../..
urad=$root/build/urad
work=$(mkdir -p "$1" && realpath "$1")
shift
methods=(fixed-moment net fixed-lambert:1 fixed-lambert:2 table hemicube:32 hemicube:64 hybrid:32 hybrid:64)
gcc -O2 -Wall -Wextra -Werror -shared -fPIC -o "$work/libicount.so" "$root/bench/icount/icount.c"
for seed in "$@"; do
  of=$work/$seed
  mkdir -p "$of"
  "$root/build/urad_plan_fit" scene "$seed" "$of"
  [[ -s $of/trained.json ]] || "$urad" --quiet train --scene "$of/room.obj" --hidden 4 --seed 1 -o "$of/trained.json" || true
  for method in "${methods[@]}"; do
    [[ ! -s $of/${method/:/_}.json ]] || continue
    "$urad" --quiet solve "$of/room.obj" --method "$method" --error 1e-4 --out "$of/b.csv" --report "$of/${method/:/_}.json" ||
      rm -f "$of/${method/:/_}.json"
  done
  [[ ! -s $of/trained.json ]] ||
    "$urad" --quiet solve "$of/room.obj" --method net --net "$of/trained.json" --error 1e-4 --out "$of/b.csv" --report "$of/scene_net.json"
  "$urad" --quiet bake "$of/room.obj" --method net,table --size 16 -o "$of/baked"
  "$root/firmware_style/ports/build" "$of" "$of/baked/scene.h" "$root/weights/general.h" cortex_m0
  SECONDS_MAX=600 EMULATOR_OPTIONS="-plugin file=$work/libicount.so,out=$of/counts.txt" \
    "$of/cortex_m0/emulate" cost "$of/labels.txt"
  paste "$of/labels.txt" "$of/counts.txt" >"$of/costs.txt"
  for table in scene:"$of/baked/scene.h" poses:"$of/baked/poses.h" net:"$root/weights/general.h"; do
    [[ -s ${table#*:} ]] || continue
    # `static` taken away, so that the compiler keeps what nothing uses.
    arm-none-eabi-gcc -mcpu=cortex-m0 -mthumb -Os -Dstatic= -I"$root/firmware_style/include" -x c -include "${table#*:}" \
      -c -o "$of/data.o" /dev/null
    echo "${table%%:*} $(arm-none-eabi-nm -S -t d "$of/data.o" | awk '{ n += $2 } END { print n }')"
  done >"$of/data.txt"
  if [[ -n ${URAD_SOLVES:-} ]]; then
    SECONDS_MAX=600 EMULATOR_OPTIONS="-plugin file=$work/libicount.so,out=$of/counts.txt" \
      "$of/cortex_m0/emulate" cost "$of/labels.txt" solves
    paste "$of/labels.txt" "$of/counts.txt" >"$of/solves.txt"
  fi
  echo "$seed: $(wc -l <"$of/costs.txt") regions"
done
