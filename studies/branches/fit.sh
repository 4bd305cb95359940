#!/bin/sh
# fit.sh POSTPROC POINTS.csv FITS.json X Y MODEL,MODEL... [OPTION...]: every model fitted to Y over X, as one list,
# and their curves in FITS.csv. A model that is refused stands in the list with "refused" and its reason, and has no curve.
set -eu
postproc=$1
points=$2
fits=$3
x=$4
y=$5
models=$6
shift 6
work=$fits.partial
mkdir -p "$work"
# The two columns; rows of what could not be measured are left out.
awk -F, -v x="$x" -v y="$y" 'NR == 1 {
    for (i = 1; i <= NF; ++i) {
      name = $i
      sub(/ *\[.*$/, "", name)
      if (name == x) first = i
      if (name == y) second = i
    }
  }
  $first == "" || $second == "" { print FILENAME ": left out of the fit: " $1 > "/dev/stderr"; next }
  { print $first "," $second }' "$points" >"$work/points.csv"
separator='['
for model in $(echo "$models" | tr , ' '); do
  echo "$separator"
  separator=,
  if "$postproc" fit "$work/points.csv" --x "$x" --y "$y" --model "$model" "$@" --quiet -o "$work/$model.json" --curve "$work/$model.csv" 2>"$work/reason"; then
    sed -e '1d' -e '$d' "$work/$model.json"
  else
    cat "$work/reason" >&2
    printf '  {\n    "model": "%s",\n    "points": 0,\n    "r_squared": null,\n    "refused": "%s",\n' "$model" "$(tr '\n\\"' '   ' <"$work/reason" | sed 's/^.*partial[^ ]* //')"
    printf '    "x": {\n      "column": "%s"\n    },\n    "y": {\n      "column": "%s"\n    }\n  }\n' "$x" "$y"
    rm -f "$work/$model.csv"
  fi
done >"$work/fits.json"
echo ']' >>"$work/fits.json"
awk -v folder="$work" -v models="$models" -v x="$x" 'BEGIN {
  n = split(models, model, ",")
  line = x
  for (i = 1; i <= n; ++i) line = line "," model[i]
  print line
  do {
    got = 0
    at = ""
    values = ""
    for (i = 1; i <= n; ++i) {
      value = "NaN"
      file = folder "/" model[i] ".csv"
      if (!started[i]++) getline row < file
      if ((getline row < file) > 0) {
        got = 1
        split(row, part, ",")
        at = part[1]
        value = part[2]
      }
      values = values "," value
    }
    if (got) print at values
  } while (got)
}' >"$work/fits.csv"
mv "$work/fits.csv" "${fits%.json}.csv"
mv "$work/fits.json" "$fits"
rm -r "$work"
