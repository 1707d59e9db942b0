#!/usr/bin/env bash
# link.sh SOURCE BUILD SCRATCH c99|cpp package|subdirectory -- a foreign project that uses the engine and a shipped
# network: the program is the README's. It is configured with every package of the host forbidden.
set -euo pipefail
source=$1 build=$2 scratch=$3 language=$4 way=$5
rm -rf "$scratch"
mkdir -p "$scratch"
case $language in c99) name=c suffix=c ;; cpp) name=cpp suffix=cpp ;; esac
"$source/tests/link/extract.sh" "$source/README.md" "$name" >"$scratch/main.$suffix"

options=(-DPROGRAM="$scratch/main.$suffix" -DCMAKE_BUILD_TYPE=Release)
for package in glm Eigen3 nlohmann_json CLI11 fmt embree tinyobjloader Boost OpenSSL Threads doctest benchmark; do
  options+=("-DCMAKE_DISABLE_FIND_PACKAGE_$package=ON")
done
if [[ $way == package ]]; then
  cmake --install "$build" --prefix "$scratch/installed" >/dev/null
  options+=("-DCMAKE_PREFIX_PATH=$scratch/installed")
else
  options+=("-DURAD_SOURCE=$source")
fi
cmake -S "$source/tests/link/$language" -B "$scratch/build" -G Ninja "${options[@]}" -Wno-dev --no-warn-unused-cli
cmake --build "$scratch/build"
output=$("$scratch/build/program")
echo "$output"
[[ -n $output ]] || { echo "the program of the README printed nothing"; exit 1; }
