#!/bin/sh
# measure.sh POSTPROC METRIC RUN.h5 METRIC.json [OPTION...]: one number of a run. What cannot be measured is said, and leaves a
# file with "value": null, so that the other runs of a figure still make it.
set -eu
postproc=$1
metric=$2
run=$3
output=$4
shift 4
code=0
"$postproc" "$metric" "$run" --quiet -o "${output%.json}.new.json" "$@" 2>"$output.partial" || code=$?
case $code in
  0)
    cat "$output.partial" >&2
    # A modulus of the first rows, taken for want of a window, is none.
    if grep -q 'ends with nothing: no window' "${output%.json}.new.json"; then
      sed -i 's/^  "value": .*/  "value": null,/; s/^  "\(modulus_over_grains[a-z_]*\)": .*/  "\1": null,/' "${output%.json}.new.json"
    fi
    mv "${output%.json}.new.json" "$output"
    ;;
  2)
    cat "$output.partial" >&2
    {
      printf '{\n  "metric": "%s",\n  "value": null,\n  "notes": ["' "$metric"
      tr '\n\\"' '   ' <"$output.partial"
      printf '"]\n}\n'
    } >"${output%.json}.new.json"
    mv "${output%.json}.new.json" "$output"
    ;;
  *)
    cat "$output.partial" >&2
    exit "$code"
    ;;
esac
rm -f "$output.partial"
