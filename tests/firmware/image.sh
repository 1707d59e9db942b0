#!/usr/bin/env bash
# image.sh IMAGE STACK_BYTES FLASH_MAX RAM_MAX [table] -- sizes of a Cortex-M image, and that no factors or radiosities hide in it:
# every object in flash of 512 bytes or more must be a table of the engine, the network, or geometry of the scene; with
# `table` its pose table, too.
set -euo pipefail
image=$1 stack=$2 flash_max=$3 ram_max=$4 poses=${5:+|pose_value_uq32|pose_block}
read -r flash ram < <(arm-none-eabi-size -A "$image" | awk '
  $1 ~ /^\.(text|rodata|init_array|data)$/ { flash += $2 }
  $1 ~ /^\.(data|bss)$/ { ram += $2 }
  END { print flash + 0, ram + 0 }')
echo "flash $flash of $flash_max bytes, RAM $((ram + stack)) of $ram_max ($ram static, $stack stack)"
((flash > 0 && flash <= flash_max)) || { echo "too much flash"; exit 1; }
((stack > 0 && ram + stack <= ram_max)) || { echo "too much RAM"; exit 1; }

objects=$(arm-none-eabi-nm --size-sort -S -C -t d "$image" | awk '$3 ~ /^[rRVdD]$/ && $2 >= 512 { print $2, $4 }')
echo "objects in flash of 512 bytes and more:"
echo "${objects:-none}"
strange=$(grep -vE " (urad::table::k|urad::k|urad_[a-z0-9_]+_(hidden_weight|grid|polygon|surface|vertex|blocker|log2_scale_q24$poses)\$)" <<<"$objects" || true)
[[ -z ${strange//[$'\n']/} ]] || { echo "not known to be table, network or geometry:"; echo "$strange"; exit 1; }
