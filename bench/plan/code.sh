#!/usr/bin/env bash
# code.sh WORK -- flash that each kind of method takes of the engine, linked, Cortex-M0, -Os: "code KIND BYTES". A program
# that solves by the C interface, less one that does nothing.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
work=$(mkdir -p "$1/code" && realpath "$1/code")
source=$here/../../firmware_style
cmake -S "$source" -B "$work/engine" -G Ninja --toolchain ports/boards/microbit.cmake -DCMAKE_BUILD_TYPE=MinSizeRel \
  --no-warn-unused-cli >/dev/null
cmake --build "$work/engine" -- --quiet | { grep -v "no work to do" || true; }
program() {  # NAME STATEMENTS
  cat >"$work/$1.c" <<END
#include "urad/urad.h"
extern const urad_scene scene; extern const urad_net net; extern const urad_pose_table poses;
extern const urad_hemicube_table cells; extern urad_source source; extern urad_counters counters;
extern urad_radiosity state; extern uint64_t memory[]; extern int32_t red;
void memcpy(void) {} void memset(void) {}
void start(void) { $2 }
END
  arm-none-eabi-gcc -mcpu=cortex-m0 -mthumb -Os -ffreestanding -w -I"$source/include" -c -o "$work/$1.o" "$work/$1.c"
  arm-none-eabi-ld --gc-sections -e start --unresolved-symbols=ignore-all -o "$work/$1.elf" "$work/$1.o" \
    "$work/engine/liburad.a" "$(arm-none-eabi-gcc -mcpu=cortex-m0 -mthumb -print-libgcc-file-name)"
  arm-none-eabi-size -A "$work/$1.elf" | awk '$1 ~ /^\.(text|rodata)/ { n += $2 } END { print n + 0 }'
}
solve='urad_radiosity_init(&state, &scene, &source, URAD_OVERSHOOT, 49, memory, 9);
  while (!urad_radiosity_done(&state, URAD_PERCENT)) urad_radiosity_step(&state);
  urad_radiosity_get(&state, 0, 0, &red);'
hemicube='urad_hemicube_source_init(&source, &scene, &cells, 0, 0, &counters, memory, 9);'
nothing=$(program nothing "")
for kind in pairs table hemicube hybrid; do
  case $kind in
    pairs) init='urad_pair_source_init(&source, &scene, 1, &net, 64, &counters, memory, 9);' ;;
    table) init='urad_pose_source_init(&source, &scene, &poses, &counters, memory, 9);' ;;
    hemicube) init=$hemicube ;;
    hybrid) init="$hemicube urad_hybrid_source_init(&source, &source, 1, &net, 1, 1365, memory, 9);" ;;
  esac
  echo "code $kind $(($(program "$kind" "$init $solve") - nothing))"
done
