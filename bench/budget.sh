#!/usr/bin/env bash
# budget.sh WORK [OUT.md] -- writes docs/BUDGET.md: what the engine needs on a chip, beside the goals of docs/DESIGN.md.
# WORK is where bench/icount/run.sh has built and counted (WORK/icount.json, WORK/BOARD/solve). Every number comes from
# arm-none-eabi-size, from the solve program on the emulated board, or from the instruction counter.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
work=$(realpath "$1")
out=${2:-$here/../docs/BUDGET.md}
counts=$work/icount.json
[[ -s $counts ]] || { echo "$counts is missing: bench/icount/run.sh writes it"; exit 1; }
mapfile -t boards < <(sed -nE 's/^  "([^"]+)": \{$/\1/p' "$counts")

cmake -S "$here/../firmware_style" -B "$work/size" -G Ninja --toolchain ports/boards/microbit.cmake \
  -DCMAKE_BUILD_TYPE=MinSizeRel --no-warn-unused-cli >/dev/null
cmake --build "$work/size" -- --quiet | { grep -v "no work to do" || true; }

# sizes: module, code, tables, static RAM. What several modules emit alike (inline functions, tables of headers) is linked
# once and counted once, under "shared".
sizes=$(arm-none-eabi-size -A "$work/size/liburad.a" | awk '
  / \(ex / { module = $1; sub(/\.cpp\..*/, "", module); next }
  !/^\./ || $2 == 0 { next }
  {
    kind = $1 ~ /^\.text/ ? "code" : $1 ~ /^\.rodata/ ? "tables" : $1 ~ /^\.(data|bss)/ ? "ram" : ""
    if (kind == "") next
    name = $1
    if (name ~ /GLOBAL__N|^\.(text|rodata|data|bss)$|^\.rodata\.(str|cst)/) name = module name
    ++users[name]; size[name] = $2; of[name] = kind; home[name] = module
  }
  END {
    for (name in size) {
      module = users[name] > 1 || name ~ /urad5table/ ? "shared" : home[name]
      sum[module, of[name]] += size[name]; modules[module]
    }
    for (module in modules)
      print module, sum[module, "code"] + 0, sum[module, "tables"] + 0, sum[module, "ram"] + 0
  }' | LC_ALL=C sort)
total() { awk -v want="$1" -v column="$2" '$1 ~ "^(" want ")$" { n += $column } END { print n + 0 }' <<<"$sizes"; }
core='shared|patch|pair|clip|form_factor|pair_source|network|radiosity|radiosity_init|radiosity_read'

count() {  # BOARD WHAT: mean instructions, empty when it was not counted
  awk -v board="\"$1\":" -v what="\"$2\":" '
    $1 ~ /^"/ && $2 == "{" && $3 == "" { inside = $1 == board }
    inside && $1 == what { for (k = 2; k < NF; ++k) if ($k == "\"mean\":") print $(k + 1) + 0 }' "$counts"
}
grouped() { sed -E ':a; s/^([0-9]+)([0-9]{3})/\1,\2/; ta' <<<"${1:--}"; }
per_pair_of_run() { local n; n=$(count "$1" "$2"); [[ -z $n ]] || echo $(((n + 24) / 49)); }
solved() {  # BOARD FIELD: a number of the line that the solve program prints
  sed -nE "s/.* $2 ([0-9]+).*/\1/p" "$work/$1/budget.txt" | head -n 1
}
for board in "${boards[@]}"; do
  "$work/$board/emulate" solve - "$work/$board/budget_light.txt" | sed 's/^/ /' >"$work/$board/budget.txt"
done
state=$(arm-none-eabi-nm -S -t d -C "$work/microbit/solve" | awk '$NF ~ /::g_memory$/ { print $2 + 0 }')
flash=$(arm-none-eabi-size -A "$work/microbit/solve" | awk '$1 ~ /^\.(text|rodata|init_array|data)$/ { n += $2 } END { print n }')

{
  cat <<'END'
# Budget

Written by `./run targets` (bench/budget.sh). Goals are what the project set out to reach. Instructions are counted one by one
in an emulator (bench/icount), not timed; the scene is the report's cube, 294 patches, with its own network.

## Flash of the engine, Cortex-M0, -Os

`arm-none-eabi-size -A liburad.a`, bytes. "shared": inline functions and tables that several modules use, linked once.

| module | code | tables | static RAM |
| --- | ---: | ---: | ---: |
END
  while read -r module code tables ram; do
    echo "| $module | $(grouped "$code") | $(grouped "$tables") | $ram |"
  done <<<"$sizes"
  cat <<END
| all | $(grouped "$(total '.*' 2)") | $(grouped "$(total '.*' 3)") | $(total '.*' 4) |

| what | bytes | goal |
| --- | ---: | ---: |
| code of kernel, network and solver (${core//|/, }) | $(grouped "$(total "$core" 2)") | 8,192 |
| their tables | $(grouped "$(total "$core" 3)") | 4,096 |
| static RAM of the engine | $(total '.*' 4) | 0 |

## The cube on the micro:bit

The program firmware_style/ports/solve_main.cpp, -O2, until the error estimate is 1 %.

| what | bytes | goal |
| --- | ---: | ---: |
| flash: engine, network, scene, program | $(grouped "$flash") | 262,144 |
| RAM: light of up to 300 patches and one run of factors, the caller's memory | $(grouped "$state") | - |
| RAM: all static data of the program, that included | $(grouped "$(solved microbit static)") | - |
| RAM: deepest stack, painted and read back, program included | $(grouped "$(solved microbit stack)") | 512 |
| RAM never touched, of 16,384 | $(grouped "$(solved microbit untouched)") | - |

## Instructions

Means over all pairs of one patch with the other walls, all runs of 49, the first 8 shots; -: does not apply. A pair by
itself includes finding both patches and looking whether they face each other; "in runs" is a run of 49 shared by its pairs.

END
  printf '| what | goal (Cortex-M0) |'; printf ' %s |' "${boards[@]}"; echo
  printf '| --- | ---: |'; printf ' ---: |%.0s' "${boards[@]}"; echo
  row() {  # TITLE GOAL COMMAND [WHAT]
    printf '| %s | %s |' "$1" "$2"
    for board in "${boards[@]}"; do printf ' %s |' "$(grouped "$($3 "$board" ${4:-})")"; done
    echo
  }
  row "pair by the centre kernel" - count pair_centre
  row "pair by the moment kernel" - count pair_moment
  row "pair by the network" "1,300 (M3 900, M4 700)" count pair_network
  row "pair by the network, cut by a plane" - count pair_network_clipped
  row "far pair, network skipped" - count pair_network_far
  row "pair by auto, 1 %, without a network" - count pair_auto
  row "one point of an exact sum" - count pair_point
  row "pair by the network of 1996 (24-50-1)" - count pair_legacy
  row "pair by the network, in runs" 600 per_pair_of_run run_network
  row "pair by the network of 1996 (24-50-1), in runs" - per_pair_of_run run_legacy
  row "run of 49 by the network" - count run_network
  row "shot, solver alone" - count shot_solver_alone
  row "shot by the moment kernel" - count shot_moment
  row "shot by the network" - count shot_network
  row "shot by pose table" - count shot_table
  row "shot by the network of 1996 (24-50-1)" - count shot_legacy
  row "shot by hemicube:32" - count shot_hemicube_32
  row "shot by hemicube:32, near pairs by the network" - count shot_hemicube_32_near_network
  row "shot by hemicube:64" - count shot_hemicube_64
  row "shot by hemicube:64, near pairs by the network" - count shot_hemicube_64_near_network
  row "solve by the network, 1 %" "30,000,000" count solve_network
  row "solve by pose table, 1 %" "5,000,000" count solve_table
  row "shots of the solve by the network" - solved shots
  row "deepest stack, bytes" 512 solved stack
} >"$work/BUDGET.md"
mkdir -p "$(dirname "$out")"
mv "$work/BUDGET.md" "$out"
