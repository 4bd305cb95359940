#!/bin/sh
# measure.sh BIN PACKING FOLDER: every measurement of the study into a file of its own in FOLDER
# (studies/common/measure.sh).
set -eu
bin=$1
packing=$2
folder=$3
program=nodal-pressure
. studies/common/measure.sh
measure frequencies.csv frequencies
for mode in spheroidal breathing torsional; do
  measure vibration-tet4-anp-5-$mode.csv vibration tet4-anp 5 $mode 30000 2000 0
  measure vibration-tet4-5-$mode.csv vibration tet4 5 $mode 30000 2000 0
done
for mode in spheroidal breathing; do
  measure vibration-tet4-anp-8-$mode.csv vibration tet4-anp 8 $mode 10000 2000 0
done
for element in tet4-anp tet4-patch tet4; do
  measure vibration-$element-4-noise.csv vibration $element 4 noise 100000 2000 0
  measure flattening-$element-5.csv flattening $element 5
  measure flattening-$element-7.csv flattening $element 7
  measure cycles-$element.csv cycles $element "$packing" 20
done
measure vibration-tet4-anp-4-noise-slow.csv vibration tet4-anp 4 noise 100000 200 0
measure vibration-tet4-anp-4-noise-viscous.csv vibration tet4-anp 4 noise 100000 2000 1
