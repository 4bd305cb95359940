#!/bin/sh
# measure.sh BIN PACKING FOLDER: every measurement of the study into a file of its own in FOLDER
# (studies/common/measure.sh).
set -eu
bin=$1
packing=$2
folder=$3
program=contact-surface
. studies/common/measure.sh
# Orientations: seeds 1 to 20 are 40 turned spheres, so 40 contacts with a wall and 20 between spheres.
measure rotations-tet4-anp-exact-5.csv rotations tet4-anp exact 5 1 20
measure rotations-tet4-exact-5.csv rotations tet4 exact 5 1 20
measure rotations-tet4-anp-inscribed-5.csv rotations tet4-anp inscribed 5 1 20
measure rotations-tet4-anp-exact-7.csv rotations tet4-anp exact 7 1 10
measure rotations-tet4-anp-inscribed-7.csv rotations tet4-anp inscribed 7 1 6
measure rotations-tet4-anp-exact-10.csv rotations tet4-anp exact 10 1 3
measure rotations-tet4-anp-smooth-5.csv rotations tet4-anp smooth 5 1 20
measure rotations-tet4-anp-smooth-7.csv rotations tet4-anp smooth 7 1 6
measure geometry.csv geometry
# Unequal meshes.
measure unequal-4-4.csv unequal tet4-anp 4 4 1 4
measure unequal-8-4.csv unequal tet4-anp 8 4 1 2
measure unequal-8-8.csv unequal tet4-anp 8 8 1 2
measure unequal-3-3.csv unequal tet4-anp 3 3 1 4
measure unequal-9-3.csv unequal tet4-anp 9 3 1 2
# Pressure from node to node.
for size in 5 7; do
  measure pressure-tet4-anp-smooth-$size-10.csv pressure tet4-anp $size 10 \
    "$folder/profile-tet4-anp-smooth-$size-10.csv" smooth
done
for element in tet4-anp tet4; do
  measure pressure-$element-7-10.csv pressure $element 7 10 "$folder/profile-$element-7-10.csv"
  for factor in 1 10 100; do
    measure pressure-$element-5-$factor.csv pressure $element 5 $factor "$folder/profile-$element-5-$factor.csv"
    measure packing-$element-$factor.csv packing $element "$packing" $factor
  done
done
