#!/usr/bin/env bash
# cube.sh WORK -- counts the report's cube by its own network, of four hidden neurons: WORK/cube7/costs.txt. With the general
# network's eight it tells what a neuron costs.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
work=$(mkdir -p "$1" && realpath "$1")
of=$work/cube7
"$root/build/urad" --quiet bake cube7 --method net,table --size 16 -o "$of/baked"
"$root/firmware_style/ports/build" "$of" "$of/baked/scene.h" "$root/weights/cube7.h" cortex_m0
SECONDS_MAX=600 EMULATOR_OPTIONS="-plugin file=$work/libicount.so,out=$of/counts.txt" "$of/cortex_m0/emulate" cost "$of/labels.txt"
paste "$of/labels.txt" "$of/counts.txt" >"$of/costs.txt"
