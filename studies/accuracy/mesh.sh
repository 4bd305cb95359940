#!/bin/sh
# mesh.sh PACK_GEN KIND FINENESS OUTPUT.h5: the mesh of a case.
#   free             four spheres of R = 0.1 mm side by side, FINENESS elements in the radius, each mesh turned at
#                    random, so that their mean depends less on how a mesh happens to meet the planes
#   confined         one such sphere in a close box
#   pair, pull-off   hemispheres of R = 0.1 mm, FINENESS elements in the contact radius; the elements far from it
#                    follow, 0.12 R at 7 and 6 elements (fig05 and fig04 leave them so at all)
#   small, full      the packings of 25 and 329 grains, nominal element size of FINENESS mm
set -eu
pack_gen=$1
kind=$2
fineness=$3
output=$4
spheres=${output%.h5}.spheres
over() { awk -v a="$1" -v b="$2" 'BEGIN { printf "%.6g", a / b }'; }
smaller() { awk -v a="$1" -v b="$2" 'BEGIN { print a < b ? a : b }'; }

# contact radius in mm, over the reach of the fine elements, elements in it where those far away are 0.12 R
hemispheres() {
  size=$(over "$1" "$fineness")
  far=$(awk -v n="$3" -v f="$fineness" 'BEGIN { printf "%.6g", 0.012 * n / f }')
  "$pack_gen" hemispheres --radius 0.1 --size "$far" --contact-size "$size" --contact-radius "$(over "$1" "$2")" \
    --bulk-size "$(smaller "$(over "$size" 0.5)" "$far")" --gap 1e-6 --quiet -o "$output"
}

spheres() { # how many in a row and a column, width of the place of each in mm
  awk -v n="$1" -v w="$2" 'BEGIN {
    print "x,y,z,radius"
    for (i = 0; i < n; ++i) for (j = 0; j < n; ++j) printf "%g,%g,0.105,0.1\n", (i + 0.5) * w, (j + 0.5) * w
  }' >"$spheres.csv"
  width=$(awk -v n="$1" -v w="$2" 'BEGIN { print n * w }')
  "$pack_gen" import "$spheres.csv" --box "$width,$width,0.21" --quiet -o "$spheres.h5"
  "$pack_gen" mesh "$spheres.h5" --size "$(over 0.1 "$fineness")" --threads 1 --quiet -o "$output"
  rm "$spheres.csv" "$spheres.h5"
}

case $kind in
  free) spheres 2 0.26 ;;
  confined) spheres 1 0.21 ;;
  # Contact radius at an approach of 0.08 R by the similarity law, and at the pull-off of Johnson, Kendall and Roberts
  # with 0.1 N/mm.
  pair) hemispheres 0.0278586 0.909 7 ;;
  pull-off) hemispheres 0.00685143 0.714 6 ;;
  small) "$pack_gen" mesh out/packings/smoke/spheres.h5 --size "$fineness" --threads 1 --quiet -o "$output" ;;
  full) "$pack_gen" mesh out/packings/full/spheres.h5 --size "$fineness" --threads 1 --quiet -o "$output" ;;
  *) echo "mesh.sh: found $kind, allowed: free, confined, pair, pull-off, small, full" >&2 && exit 2 ;;
esac
