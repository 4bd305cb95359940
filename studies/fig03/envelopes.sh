#!/bin/sh
# envelopes.sh MPFEM LAW WORK: traction against opening to failure for four fracture energies and both softening laws, at
# openings in equal ratios, on standard output. WORK: folder for programme and result of one walk.
set -eu
mpfem=$1 law=$2 work=$3
awk 'BEGIN {
  print "opening,shear1,shear2,increments"
  for (i = 0; i <= 1400; ++i) printf "%.8g,0,0,1\n", 10 ^ (-7 + 7 * i / 1400)
}' > "$work/programme.csv"
echo 'softening,fracture_energy_N_per_mm,opening_mm,traction_MPa'
for softening in exponential energy; do
  for energy in 0.001 0.01 0.1 0.5; do
    "$mpfem" bond "$law" "$work/programme.csv" -o "$work/result.csv" --quiet \
      --set bond.softening=$softening --set bond.fracture_energy=$energy
    awk -F, -v case="$softening,$energy" '
      NR == 1 { for (i = 1; i <= NF; ++i) column[$i] = i; next }
      $column["opening_mm"] > 0 { print case "," $column["opening_mm"] "," $column["normal_traction_MPa"] }' "$work/result.csv"
  done
done
