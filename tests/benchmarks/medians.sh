#!/usr/bin/env bash
# For performance.sh and features.sh, which source it: reading what `mpfem bench --json` wrote.

# value FILE KEY
value() { awk -v key="\"$2\":" '$1 == key { sub(/,$/, "", $2); print $2 }' "$1"; }

# median KEY FILE...
median() {
  local key=$1 file
  shift
  for file in "$@"; do value "$file" "$key"; done | sort -g | sed -n "$((($# + 1) / 2))p"
}
