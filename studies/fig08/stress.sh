#!/bin/sh
# stress.sh LABEL:DENSITY:SECTION.csv...: von Mises stress on each section, as one table on standard output.
set -eu
echo 'mesh,relative_density,mean_MPa,median_MPa,percentile_95_MPa,percentile_99_MPa,largest_MPa,share_above_yield'
for entry in "$@"; do
  label=${entry%%:*}
  rest=${entry#*:}
  # 25 MPa is the yield stress of studies/compaction/compaction.toml.
  LC_ALL=C sort -t, -k3,3g "${rest#*:}" |
    awk -f studies/fig08/percentiles.awk -v label="$label" -v density="${rest%%:*}" -v yield_stress=25
done
