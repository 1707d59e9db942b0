#!/usr/bin/env bash
# run.sh WORK SCENE.h NET.h BOARD... -- instructions of the engine's parts on each emulated board, counted one by one.
# PROGRAM: count (the default) or skips, and SETTING for its second word. Writes WORK/icount.json: {board: {what: {"regions": n, "mean": instructions, "worst": instructions}}}.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
work=$1 scene=$2 net=$3
shift 3
"$here/../../firmware_style/ports/build" "$work" "$scene" "$net" "$@"
work=$(realpath "$work")
gcc -O2 -Wall -Wextra -Werror -shared -fPIC -o "$work/libicount.so" "$here/icount.c"

for board in "$@"; do
  counts=$work/$board/counts.txt labels=$work/$board/labels.txt
  EMULATOR_OPTIONS="-plugin file=$work/libicount.so,out=$counts" "$work/$board/emulate" "${PROGRAM:-count}" "$labels" ${SETTING:+"$SETTING"}
  [[ $(wc -l <"$counts") == $(wc -l <"$labels") ]] || { echo "$board: regions and labels do not match"; exit 1; }
  paste "$labels" "$counts" | sed "s/^/$board\t/"
done | awk -F'\t' '
  { key = $1 FS $2 }
  !(key in n) { order[++keys] = key }
  { ++n[key]; sum[key] += $3; if ($3 > worst[key]) worst[key] = $3 }
  $2 == "empty" && $3 != 0 { print "an empty region counts " $3 " instructions" >"/dev/stderr"; exit 1 }
  END {
    printf "{"
    for (k = 1; k <= keys; ++k) {
      split(order[k], part, FS)
      if (part[1] != board) printf "%s\n  \"%s\": {", board == "" ? "" : "\n  },", part[1]
      else printf ","
      board = part[1]
      key = order[k]
      printf "\n    \"%s\": { \"regions\": %d, \"mean\": %.0f, \"worst\": %.0f }", part[2], n[key], sum[key] / n[key], worst[key]
    }
    print "\n  }\n}"
  }' >"$work/icount.json.part"
mv "$work/icount.json.part" "$work/icount.json"
cat "$work/icount.json"
