#!/usr/bin/env bash
# closed_form.sh ARCHIVE -- fails unless the closed form asks the host library for nothing but the clipper, the polygon's
# moments, boundary and order, and its own parts: a second truth must not lean on the first. Whitelist: what is not named fails.
set -euo pipefail
archive=$1

members='(closed_form|edge_pair_closed|dilogarithm)\.cpp\.o'
allowed='^host::(clip_to_front|moments|boundary|standard_order|written_before|closed_log_integral|dilogarithm)\('
allowed+='|^host::Bounded<.*> host::closed_log_integral<|^std::complex<.*> host::dilogarithm<'

symbols=$(nm --print-file-name --demangle "$archive" 2>/dev/null | grep -E ":$members:")
count=$(cut -d: -f2 <<<"$symbols" | sort -u | wc -l)
((count == 3)) || { echo "$archive: holds $count of the 3 object files of the closed form"; exit 1; }

asked=$(sed -nE 's/.*: +U //p' <<<"$symbols" | grep 'host::' | sort -u)
bad=$(grep -vE "$allowed" <<<"$asked" || true)
if [[ -z $asked || -n $bad ]]; then
  echo "the closed form needs what it promises to do without:"
  echo "${bad:-nothing at all?}"
  exit 1
fi
echo "the closed form needs: $(tr '\n' ';' <<<"$asked")"
