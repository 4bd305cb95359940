#!/bin/sh
# paths.sh areas|envelopes MPFEM LAW WORK: paths of one contact point, as a table on standard output. WORK: folder for
# the programme and the result of one path.
# paths.sh checks AREAS.csv PATH.csv...: what the statements need of the paths row by row, as a table of one row.
# PATH.csv: loading, unloading, reloading and compression.
# areas: straight paths to failure in three modes, with both softening laws, four fracture energies and four step sizes;
# the work of each. envelopes: traction against opening to failure for four fracture energies and both laws, at openings
# in equal ratios.
set -eu
part=$1
shift

areas() {
  constant() { # the value of a key of LAW
    awk -F= -v key="$1" '
      { name = $1; gsub(/[ \t]/, "", name); sub(/#.*/, "", $2) }
      name == key { print $2 + 0; exit }' "$law"
  }
  stiffness=$(constant stiffness) tensile=$(constant tensile_strength) shear=$(constant shear_strength)

  columns=softening,fracture_energy_N_per_mm,mode,increments,strength_MPa,expected_peak_MPa,peak_MPa
  columns=$columns,work_N_per_mm,trapezoidal_work_N_per_mm,largest_difference_N_per_mm,state
  echo "$columns"
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
              if (softening == "exponential") last = first + exponent * b / strength
              else last = sqrt(first ^ 2 + 2 * exponent * b / k)
              print "opening,shear1,shear2,increments" > programme
              printf "%.17g,%.17g,0,%d\n", opening * first, sliding * first, n / 10 > programme
              printf "%.17g,%.17g,0,%d\n", opening * last, sliding * last, n - n / 10 > programme
              peak = strength
              if (softening == "energy" && b / k > first ^ 2) peak = sqrt(k * b) * exp((strength * first / b - 1) / 2)
              printf "%.17g,%.17g\n", strength, peak
            }')
          "$mpfem" bond "$law" "$work/programme.csv" -o "$work/result.csv" --quiet \
            --set bond.softening=$softening --set bond.fracture_energy=$energy
          awk -F, -v which="$softening,$energy,$mode,$increments,$peaks" '
            NR == 1 { for (i = 1; i <= NF; ++i) column[$i] = i; next }
            {
              traction = sqrt($column["normal_traction_MPa"] ^ 2 + $column["shear1_traction_MPa"] ^ 2)
              if (traction > peak) peak = traction
              work = $column["work_N_per_mm"]
              trapezoid = $column["trapezoidal_work_N_per_mm"]
              state = $column["state"]
              difference = work > trapezoid ? work - trapezoid : trapezoid - work
              if (difference > largest) largest = difference
            }
            END { printf "%s,%.12g,%.12g,%.12g,%.4g,%s\n", which, peak, work, trapezoid, largest, state }
          ' "$work/result.csv"
        done
      done
    done
  done
}

envelopes() {
  awk 'BEGIN {
    print "opening,shear1,shear2,increments"
    for (i = 0; i <= 1400; ++i) printf "%.8g,0,0,1\n", 10 ^ (-7 + 7 * i / 1400)
  }' > "$work/programme.csv"
  echo 'softening,fracture_energy_N_per_mm,opening_mm,traction_MPa'
  for softening in exponential energy; do
    for energy in 0.001 0.01 0.1 0.5; do
      "$mpfem" bond "$law" "$work/programme.csv" -o "$work/result.csv" --quiet \
        --set bond.softening=$softening --set bond.fracture_energy=$energy
      awk -F, -v which="$softening,$energy" '
        NR == 1 { for (i = 1; i <= NF; ++i) column[$i] = i; next }
        $column["opening_mm"] > 0 { print which "," $column["opening_mm"] "," $column["normal_traction_MPa"] }
      ' "$work/result.csv"
    done
  done
}

# First file: straight paths to failure; the others: loading, unloading, reloading and compression.
checks() {
  awk -v CONVFMT=%.17g '
    BEGIN { FS = "," }

    FNR == 1 {
      ++file
      split("", column)
      for (i = 1; i <= NF; ++i) column[$i] = i
      next_is_first = 1
      next
    }

    # Number of a column.
    function at(name) {
      if (name in column) return column[name]
      print FILENAME ": no column " name > "/dev/stderr"
      failed = 1
      exit 1
    }
    function absolute(x) { return x < 0 ? -x : x }

    function larger(a, b) { return a > b ? a : b }

    file == 1 {
      law = $at("softening")
      g = $at("fracture_energy_N_per_mm")
      n = $at("increments")
      account = larger(account, absolute($at("work_N_per_mm") / g - 1))
      trapezoid[n] = larger(trapezoid[n], absolute($at("trapezoidal_work_N_per_mm") / g - 1))
      along[n] = larger(along[n], $at("largest_difference_N_per_mm") / g)
      if ($at("state") == "broken") ++broken
      ++paths
      peak = $at("peak_MPa")
      expected = $at("expected_peak_MPa")
      if (law == "exponential") {
        name = $at("mode")
        if (!(name in deviation) || absolute(peak / expected - 1) >= deviation[name]) {
          deviation[name] = absolute(peak / expected - 1)
          reached[name] = peak
        }
      } else if (n == 20000 && $at("mode") == "normal") {
        beyond_deviation = larger(beyond_deviation, absolute(peak / expected - 1))
      }
    }

    file > 1 {
      opening = $at("opening_mm")
      shear = $at("shear1_mm")
      normal_traction = $at("normal_traction_MPa")
      shear_traction = $at("shear1_traction_MPa")
      damage = $at("damage")
      if (opening < 0) {
        penalty = normal_traction / opening
        if (!first_penalty) first_penalty = penalty
        penalty_deviation = larger(penalty_deviation, absolute(penalty / first_penalty - 1))
        if (damage > 0) ++compressed_damaged
        if (!next_is_first && damage != last_damage) ++damaged_by_compression
      }
      # Without growth of damage, below it: as steep as where the growth ended.
      if (!next_is_first && damage == last_damage && damage > 0 && damage < 1) {
        if (opening > 0) unloading = larger(unloading, absolute(normal_traction / opening / normal_slope - 1))
        if (shear != 0) unloading = larger(unloading, absolute(shear_traction / shear / shear_slope - 1))
        ++unloading_rows
      } else {
        if (opening > 0) normal_slope = normal_traction / opening
        if (shear != 0) shear_slope = shear_traction / shear
      }
      if (!next_is_first && damage < last_damage) ++healed
      last_damage = damage
      next_is_first = 0
    }

    function give(name, value) {
      heading = heading (heading == "" ? "" : ",") name
      row = row (row == "" ? "" : ",") value + 0
    }

    END {
      if (failed) exit 1
      # The numbers of the paper are written here, not taken from the law that was driven.
      deviation["normal"] = larger(deviation["normal"], absolute(reached["normal"] / 25 - 1))
      deviation["shear"] = larger(deviation["shear"], absolute(reached["shear"] / 18 - 1))
      mixed = reached["mixed"] * sqrt(0.5 / 25 ^ 2 + 0.5 / 18 ^ 2)
      deviation["mixed"] = larger(deviation["mixed"], absolute(mixed - 1))
      for (i = split("normal shear mixed", mode, " "); i > 0; --i) {
        give(mode[i] "_peak", reached[mode[i]])
        give(mode[i] "_deviation", deviation[mode[i]])
      }
      for (i = split("20 200 2000 20000", increments, " "); i > 0; --i)
        give("trapezoid_" increments[i], trapezoid[increments[i]])
      give("along", along[20000])
      give("account", account)
      give("paths", paths)
      give("broken", broken)
      give("unloading", unloading)
      give("unloading_rows", unloading_rows)
      give("healed", healed)
      give("penalty_deviation", penalty_deviation)
      give("compressed_rows", compressed_damaged)
      give("compression_changes", damaged_by_compression)
      give("beyond_deviation", beyond_deviation)
      print heading
      print row
    }
  ' "$@"
}

case $part in
checks) checks "$@" ;;
areas | envelopes)
  mpfem=$1 law=$2 work=$3
  mkdir -p "$work"
  "$part"
  rm -rf "$work"
  ;;
*)
  echo "paths.sh: found '$part', allowed: areas, envelopes, checks" >&2
  exit 2
  ;;
esac
