#!/usr/bin/env bash
# lint.sh BUILD OUT.md [FOLDER...] -- clang-tidy (.clang-tidy) and cppcheck (cppcheck.txt) on the sources below the folders,
# firmware_style/src and host by default. BUILD holds compile_commands.json. Fails where either finds something.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
build=$(realpath "$1") out=$(realpath -m "$2")
shift 2
folders=("${@:-firmware_style/src host/lib host/tool}")
cd "$here/../.."
# shellcheck disable=SC2068  # each word is a folder
mapfile -t files < <(find ${folders[@]} -name '*.cpp' | LC_ALL=C sort)
mkdir -p "$(dirname "$out")"
found=$(mktemp)
trap 'rm -f "$found"' EXIT

cppcheck --quiet --std=c++20 --language=c++ --enable=warning,performance,portability --inline-suppr \
  --suppressions-list="$here/cppcheck.txt" -j "$(nproc)" -I firmware_style/include -I host/lib --template='{file}:{line}: {message} [cppcheck {id}]' \
  "${files[@]}" 2>>"$found" || true
printf '%s\n' "${files[@]}" |
  xargs -P "$(nproc)" -n 4 nice clang-tidy --quiet -p "$build" 2>/dev/null | grep -E ': (warning|error): ' >>"$found" || true

findings=$(sort -u "$found" | grep -c '\[' || true)
{
  echo "$(clang-tidy --version | grep -oE 'version [0-9.]+' | head -1 | sed 's/^/clang-tidy /') with .clang-tidy, $(cppcheck --version) with tests/lint/cppcheck.txt;"
  echo "-Wall -Wextra -Wpedantic -Wconversion -Wshadow are errors in every build."
  echo
  echo "| files | findings | goal |"
  echo "| --: | --: | --: |"
  echo "| ${#files[@]} | $findings | 0 |"
  if ((findings)); then
    echo
    echo "| check | findings |"
    echo "| --- | --: |"
    sort -u "$found" | grep -oE '\[[^]]*\]$' | sort | uniq -c | sort -rn | awk '{ n = $1; $1 = ""; print "|" $0 " | " n " |" }'
  fi
} >"$out"
sort -u "$found" >&2
((findings == 0))
