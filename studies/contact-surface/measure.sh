#!/bin/sh
# measure.sh BIN PACKING FOLDER: every measurement of the study into a file of its own in FOLDER. What is there is not
# measured again, so that an interrupted call goes on where it stood.
set -eu
bin=$1
packing=$2
folder=$3
measure() {
  file=$folder/$1
  shift
  [ -e "$file" ] && return
  echo "contact-surface $*" >&2
  "$bin/contact-surface" "$@" > "$file.partial" 2> "$file.notes"
  mv "$file.partial" "$file"
  [ -s "$file.notes" ] || rm -f "$file.notes"
}
measure geometry.csv geometry
for element in tet4-anp tet4; do
  measure rotations-$element-exact-5.csv rotations $element exact 5 1 20
  measure rotations-$element-exact-7.csv rotations $element exact 7 1 10
  for size in 5 7; do
    for factor in 1 10 100; do
      measure pressure-$element-$size-$factor.csv pressure $element $size $factor
    done
  done
  for factor in 1 10 100; do
    measure packing-$element-$factor.csv packing $element "$packing" $factor
  done
done
measure rotations-tet4-anp-exact-10.csv rotations tet4-anp exact 10 1 4
measure rotations-tet4-anp-inscribed-5.csv rotations tet4-anp inscribed 5 1 20
measure unequal-8-8.csv unequal tet4-anp 8 8 1 3
measure unequal-8-4.csv unequal tet4-anp 8 4 1 3
measure unequal-4-4.csv unequal tet4-anp 4 4 1 6
measure unequal-9-3.csv unequal tet4-anp 9 3 1 3
measure unequal-3-3.csv unequal tet4-anp 3 3 1 6
