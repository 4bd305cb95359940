#!/bin/sh
# run-case.sh CASE PACKING FOLDER BIN: runs one line of cases.csv in FOLDER; leaves CASE.h5, CASE.log (what mpfem said),
# CASE.code (its exit code) and, last, CASE.csv (its history). A failed simulation (3) is a result; any other failure is
# this script's own.
set -euf
case=$1
packing=$2
folder=$3
bin=$4
here=studies/hard-cases
line=$(grep "^$case," $here/cases.csv)
scenario=$here/$(echo "$line" | cut -d, -f4).toml
from=$(echo "$line" | cut -d, -f6)
options=$(echo "$line" | cut -d, -f7-)
code=0
rm -f "$folder/$case.h5" # mpfem would keep the old run beside the new one
# Options are words: split them.
# shellcheck disable=SC2086
"$bin/mpfem" run "$scenario" -o "$folder/$case.h5" --set "packing=$packing" $options --threads 1 \
  ${from:+--from "$folder/$from.checkpoint.h5"} 2>"$folder/$case.log" || code=$?
case $code in
0 | 3) ;;
*)
  cat "$folder/$case.log" >&2
  exit "$code"
  ;;
esac
echo "$code" >"$folder/$case.code"
"$bin/postproc" curve "$folder/$case.h5" --quiet -o "$folder/new-$case.csv"
mv "$folder/new-$case.csv" "$folder/$case.csv"
