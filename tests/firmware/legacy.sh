#!/usr/bin/env bash
# legacy.sh PROGRAM WORK [BOARD...] -- cube7 by networks of the 1996 report: the same integers on each emulated board and here.
# PROGRAM is `urad`. With boards all seven networks, without a linear and a log one on a Cortex-M0 and on RISC-V.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
program=$1 work=$2 weights=$here/../../weights
rm -rf "$work"
mkdir -p "$work"
shift 2
nets=(linear50 linear30 linear15 linear5 log30 log15 log5) boards=("$@")
(($#)) || nets=(linear5 log30) boards=(microbit riscv32)
"$program" --quiet bake cube7 --method net:cube7 --size 16 -o "$work/baked"
header=$(grep -lE '^static const urad_scene ' "$work"/baked/*.h) || { echo "bake left no scene header"; exit 1; }
for net in "${nets[@]}"; do
  echo "legacy:$net"
  URAD_LEGACY=$weights/legacy_$net.h URAD_BY=legacy "$here/compare.sh" "$work/$net" "$header" "$weights/cube7.h" "${boards[@]}"
done
