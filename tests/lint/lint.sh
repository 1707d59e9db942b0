#!/usr/bin/env bash
# lint.sh BUILD OUT.md [FOLDER...] -- clang-tidy (.clang-tidy) and cppcheck (cppcheck.txt) on the sources below the folders,
# by default all that are compiled for a host. BUILD is configured by the preset "lint". Fails where either finds something.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
build=$(realpath "$1") out=$(realpath -m "$2") jobs=${JOBS:-$(nproc)}
shift 2
cd "$here/../.."
folders=("$@")
((${#folders[@]})) || folders=(firmware_style/src host/lib host/tool tests bench)
mapfile -t files < <(grep -oP "^  \"file\": \"$PWD/\K.*\.cpp(?=\")" "$build/compile_commands.json" |
  grep -E "^($(IFS='|' && echo "${folders[*]}"))/" | LC_ALL=C sort -u)
mkdir -p "$(dirname "$out")"
found=$(mktemp)
trap 'rm -f "$found"' EXIT

cppcheck --quiet --std=c++20 --language=c++ --enable=warning,performance,portability --inline-suppr \
  --suppressions-list="$here/cppcheck.txt" -j "$jobs" -D'TEST_CASE(name)=static void test_case()' \
  -I firmware_style/include -I host/lib \
  --template='{file}:{line}: {message} [cppcheck {id}]' "${files[@]}" 2>>"$found" || true
"$here/tidy.py" "$build" "$jobs" "${files[@]}" | tee -a "$found" >&2

findings=$(sort -u "$found" | grep -c . || true)
switched_off=$(grep -cE '^#   [a-z]' .clang-tidy)
noted=$(grep -rohE 'NOLINT|cppcheck-suppress' firmware_style host tests bench --include='*.cpp' --include='*.hpp' --include='*.h' | wc -l)
{
  echo "$(clang-tidy --version | grep -oE 'version [0-9.]+' | head -1 | sed 's/^/clang-tidy /') with .clang-tidy ($switched_off lines of checks off, each with its reason), $(cppcheck --version) with"
  echo "tests/lint/cppcheck.txt, $noted suppressions in sources, each with its reason beside it; -Wall -Wextra -Wpedantic -Wconversion"
  echo "-Wshadow are errors in every build by g++ and clang++. Headers count with the sources that include them."
  echo
  echo "| sources of | files | findings | goal |"
  echo "| --- | --: | --: | --: |"
  for folder in "${folders[@]}"; do
    printf '| %s | %d | %d | 0 |\n' "$folder" "$(printf '%s\n' "${files[@]}" | grep -c "^$folder/")" \
      "$(sort -u "$found" | grep -c "^$folder/" || true)"
  done
  if ((findings)); then
    echo
    echo "| check | findings |"
    echo "| --- | --: |"
    sort -u "$found" | grep -oE '\[[^]]*\]$' | sort | uniq -c | sort -rn | awk '{ n = $1; $1 = ""; print "|" $0 " | " n " |" }'
  fi
} >"$out"
((findings == 0))
