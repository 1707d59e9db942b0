#!/usr/bin/env bash
# legacy.sh PROGRAM WORK -- cube7 by networks of the 1996 report, linear and log: the same integers on a Cortex-M0, on RISC-V and
# here. PROGRAM is `urad`.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
program=$1 work=$2 weights=$here/../../weights
rm -rf "$work"
mkdir -p "$work"
"$program" --quiet bake cube7 --method net:cube7 --size 16 -o "$work/baked"
header=$(grep -lE '^static const urad_scene ' "$work"/baked/*.h) || { echo "bake left no scene header"; exit 1; }
for net in linear5 log30; do
  echo "legacy:$net"
  URAD_LEGACY=$weights/legacy_$net.h URAD_BY=legacy "$here/compare.sh" "$work/$net" "$header" "$weights/cube7.h" microbit riscv32
done
