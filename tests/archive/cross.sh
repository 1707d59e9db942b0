#!/usr/bin/env bash
# cross.sh SOURCE BUILD BOARD TOOL_PREFIX -- builds the engine alone for a board at -Os, checks its symbols, and that it
# holds no writable data. Prints its size and leaves it in BUILD/size.txt.
set -euo pipefail
source=$1 build=$2 board=$3 prefix=$4
cmake -S "$source/firmware_style" -B "$build" -G Ninja --toolchain "ports/boards/$board.cmake" \
  -DCMAKE_BUILD_TYPE=MinSizeRel >/dev/null
cmake --build "$build"
"$source/tests/archive/symbols.sh" "$build/liburad.a" "$prefix"

"${prefix}size" -t "$build/liburad.a" | tee "$build/size.txt"
read -r _ data bss _ < <(tail -n 1 "$build/size.txt")
if ((data + bss)); then
  echo "the engine holds $data bytes of .data and $bss of .bss: all memory must be the caller's"
  exit 1
fi
