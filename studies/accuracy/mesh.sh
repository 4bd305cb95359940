#!/bin/sh
# mesh.sh PACK_GEN KIND FINENESS OUTPUT.h5: the mesh of a case.
#   free, confined   sphere of R = 0.1 mm in a wide or a close box, FINENESS elements in its radius
#   pair, pull-off   hemispheres of R = 0.1 mm, FINENESS elements in the contact radius (as studies/fig05 and fig04 have them)
#   small, full      the packings of 25 and 329 grains, nominal element size of FINENESS mm
set -eu
pack_gen=$1
kind=$2
fineness=$3
output=$4
spheres=${output%.h5}.spheres
over() { awk -v a="$1" -v b="$2" 'BEGIN { printf "%.6g", a / b }'; }
smaller() { awk -v a="$1" -v b="$2" 'BEGIN { print a < b ? a : b }'; }

hemispheres() { # contact radius in mm, how far beyond it the fine elements reach
  size=$(over "$1" "$fineness")
  "$pack_gen" hemispheres --radius 0.1 --size 0.012 --contact-size "$size" --contact-radius "$(over "$1" "$2")" \
    --bulk-size "$(smaller "$(over "$size" 0.5)" 0.012)" --gap 1e-6 --quiet -o "$output"
}

sphere() { # width and depth of the box in mm
  awk -v w="$1" 'BEGIN { print "x,y,z,radius"; printf "%g,%g,0.105,0.1\n", w / 2, w / 2 }' >"$spheres.csv"
  "$pack_gen" import "$spheres.csv" --box "$1,$1,0.21" --quiet -o "$spheres.h5"
  "$pack_gen" mesh "$spheres.h5" --size "$(over 0.1 "$fineness")" --threads 1 --quiet -o "$output"
  rm "$spheres.csv" "$spheres.h5"
}

case $kind in
  free) sphere 0.4 ;;
  confined) sphere 0.21 ;;
  # Contact radius at an approach of 0.08 R by the similarity law, and at the pull-off of Johnson, Kendall and Roberts with 0.1 N/mm.
  pair) hemispheres 0.0278586 0.909 ;;
  pull-off) hemispheres 0.00685143 0.714 ;;
  small) "$pack_gen" mesh out/packings/smoke/spheres.h5 --size "$fineness" --threads 1 --quiet -o "$output" ;;
  full) "$pack_gen" mesh out/packings/full/spheres.h5 --size "$fineness" --threads 1 --quiet -o "$output" ;;
  *) echo "mesh.sh: $kind: allowed are free, confined, pair, pull-off, small, full" >&2 && exit 2 ;;
esac
