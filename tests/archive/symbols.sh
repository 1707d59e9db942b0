#!/usr/bin/env bash
# symbols.sh ARCHIVE [TOOL_PREFIX] -- fails unless the engine asks its linker for nothing but copying memory and
# multiplying or shifting 64-bit integers: no heap, no float, no libm, no division. Whitelist: what is not named fails.
set -euo pipefail
archive=$1 prefix=${2:-}

allowed='^(mem(cpy|set|move|cmp)'             # emitted by compilers even when freestanding
allowed+='|__aeabi_(lmul|llsl|llsr|lasr|lcmp|ulcmp|mem(cpy|set|move|clr)[48]?)' # Arm: 64-bit product, shifts, comparison
allowed+='|__gnu_thumb1_case_(uqi|sqi|uhi|shi|si)'                             # Cortex-M0: switch tables
allowed+='|__clzsi2'                                                          # leading zeros, where no instruction counts them
allowed+='|__(mul|ashl|lshr|ashr|cmp|ucmp)di[23]'                              # RISC-V: the same as __aeabi_l*
allowed+='|__riscv_(save|restore)_[0-9]+'                                      # RISC-V at -Os: register spills
allowed+='|_GLOBAL_OFFSET_TABLE_)$'                                            # position independent code

defined=$("${prefix}nm" --defined-only --format=posix "$archive" 2>/dev/null | awk 'NF >= 3 { print $1 }' | sort -u)
undefined=$("${prefix}nm" -u --format=posix "$archive" 2>/dev/null | awk 'NF >= 2 && $2 == "U" { print $1 }' | sort -u)
[[ -n $defined ]] || { echo "$archive: defines nothing"; exit 1; }

outside=$(comm -13 <(echo "$defined") <(echo "$undefined"))
bad=$(grep -vE "$allowed" <<<"$outside" || true)
if [[ -n ${bad//[$'\n']/} ]]; then
  echo "$archive needs what the engine promises to do without:"
  echo "$bad" | "${prefix}c++filt"
  exit 1
fi
echo "$archive needs: $(tr '\n' ' ' <<<"${outside:-nothing}")"
