#!/bin/sh
# areas.sh MPFEM LAW WORK: straight walks to failure in three modes, with both softening laws, four fracture energies and
# four step sizes; the work of each as a table on standard output. WORK: folder for programme and result of one walk.
set -eu
mpfem=$1 law=$2 work=$3
constant() { # the value of a key of LAW
  awk -F= -v key="$1" '{ name = $1; gsub(/[ \t]/, "", name); sub(/#.*/, "", $2) } name == key { print $2 + 0; exit }' "$law"
}
stiffness=$(constant stiffness) tensile=$(constant tensile_strength) shear=$(constant shear_strength)

echo 'softening,fracture_energy_N_per_mm,mode,increments,strength_MPa,expected_peak_MPa,peak_MPa,work_N_per_mm,trapezoidal_work_N_per_mm,largest_difference_N_per_mm,state'
for softening in exponential energy; do
  for energy in 0.001 0.01 0.1 0.5; do
    for mode in normal shear mixed; do
      for increments in 20 200 2000 20000; do
        # A tenth of the increments up to the strength, so that the sharp peak is a row; the rest to failure. Printed
        # besides: strength of the mode, and the law's own peak, which the energy law reaches beyond the strength.
        peaks=$(awk -v softening=$softening -v g=$energy -v mode=$mode -v n=$increments -v k="$stiffness" \
          -v tensile="$tensile" -v shear="$shear" -v programme="$work/programme.csv" 'BEGIN {
            opening = mode == "normal" ? 1 : mode == "shear" ? 0 : sqrt(0.5)
            sliding = sqrt(1 - opening * opening)
            strength = 1 / sqrt((opening / tensile) ^ 2 + (sliding / shear) ^ 2)
            first = strength / k
            b = g - strength * first / 2
            exponent = 16.5 # a bond counts as broken from 16 on
            last = softening == "exponential" ? first + exponent * b / strength : sqrt(first ^ 2 + 2 * exponent * b / k)
            print "opening,shear1,shear2,increments" > programme
            printf "%.17g,%.17g,0,%d\n", opening * first, sliding * first, n / 10 > programme
            printf "%.17g,%.17g,0,%d\n", opening * last, sliding * last, n - n / 10 > programme
            peak = softening == "energy" && b / k > first ^ 2 ? sqrt(k * b) * exp((strength * first / b - 1) / 2) : strength
            printf "%.17g,%.17g\n", strength, peak
          }')
        "$mpfem" bond "$law" "$work/programme.csv" -o "$work/result.csv" --quiet \
          --set bond.softening=$softening --set bond.fracture_energy=$energy
        awk -F, -v case="$softening,$energy,$mode,$increments,$peaks" '
          NR == 1 { for (i = 1; i <= NF; ++i) column[$i] = i; next }
          {
            traction = sqrt($column["normal_traction_MPa"] ^ 2 + $column["shear1_traction_MPa"] ^ 2)
            if (traction > peak) peak = traction
            work = $column["work_N_per_mm"]; trapezoid = $column["trapezoidal_work_N_per_mm"]; state = $column["state"]
            difference = work > trapezoid ? work - trapezoid : trapezoid - work
            if (difference > largest) largest = difference
          }
          END { printf "%s,%.12g,%.12g,%.12g,%.4g,%s\n", case, peak, work, trapezoid, largest, state }' "$work/result.csv"
      done
    done
  done
done
