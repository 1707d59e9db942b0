#!/usr/bin/env bash
# extract.sh README LANGUAGE -- prints the code block that follows the line <!-- example: LANGUAGE -->.
set -euo pipefail
awk -v mark="<!-- example: $2 -->" '
  $0 == mark { armed = 1; next }
  armed && /^```/ { if (inside) { found = 1; exit } inside = 1; next }
  inside { print }
  END { if (!found) exit 1 }' "$1" || {
  echo "$1 has no code block after a line '<!-- example: $2 -->'" >&2
  exit 1
}
