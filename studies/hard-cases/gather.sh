#!/bin/sh
# gather.sh FOLDER CASE...: a line of summary.csv for each case that was run in FOLDER.
set -eu
folder=$1
shift
here=studies/hard-cases
columns='case,hard part,expected,exit_code,steps,relative_density,mean_stress [MPa],residual_over_largest'
columns=$columns',kinetic_over_internal_at_end,penetration_over_h,not_finite,message'
echo "$columns"
for case in "$@"; do
  awk -f studies/common/verdict.awk -f $here/row.awk \
    -v "name=$case" -v "code=$(cat "$folder/$case.code")" -v "log_file=$folder/$case.log" \
    $here/cases.csv "$folder/$case.csv"
done
