#!/usr/bin/env bash
# includes.sh SOURCE -- who may see whom: the engine sees itself and two C headers, the host library no shipped networks,
# shipped networks only the plain-data headers of the engine.
set -euo pipefail
cd "$1"
failed=0

# only ALLOWED WHAT FOLDER...: complains of every #include in the folders that does not match the pattern.
only() {
  local allowed=$1 what=$2 found
  shift 2
  found=$(grep -rnE '^[[:space:]]*#[[:space:]]*include' --include='*.h' --include='*.c' --include='*.hpp' --include='*.cpp' \
    "$@" | grep -vE "include ($allowed)" || true)
  [[ -z $found ]] || { printf '%s:\n%s\n' "$what" "$found"; failed=1; }
}

own=$(cd firmware_style/src && printf '%s|' ./*.hpp | sed 's#\./##g')
only "\"(${own}urad/[a-z0-9_]+\.hp?p?)\"|<std(int|def)\.h>" "The engine includes only itself, <stdint.h> and <stddef.h>" \
  firmware_style/include firmware_style/src
only '<|"[^w]|"w[^e]' "The host library makes and runs networks; it does not include shipped ones" host/lib
only '"urad/(net|legacy_net|scene)\.h"|<stdint\.h>' "Shipped headers include only urad/net.h, urad/legacy_net.h and urad/scene.h" weights
exit "$failed"
