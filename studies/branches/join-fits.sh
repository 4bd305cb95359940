#!/bin/sh
# join-fits.sh FITS.json...: lists as postproc fit writes them, brackets on lines of their own, as one list on standard output.
set -eu
separator='['
for list in "$@"; do
  printf '%s\n' "$separator"
  sed -e '1d' -e '$d' "$list"
  separator=,
done
echo ']'
