# awk -f ../common/verdict.awk -f drift.awk out/MESH/fig25/NAME.cycles.csv...: a row for every full cycle, with the change of
# density at the lowest and the highest stress since the cycle before. The first row holds the first loading and is left out
# (postproc numbers it 0 where it begins between the cycles' stresses, else 1).
BEGIN {
  FS = ","
  print "sample,cycle,loop_area_MPa,relative_density_at_low_stress,relative_density_at_high_stress,change_at_low_stress,change_at_high_stress," \
        "plastic_dissipation_mJ,damage_dissipation_mJ"
}
FNR == 1 {
  read_header()
  name = FILENAME
  sub(/^.*\//, "", name)
  sub(/\.cycles\.csv$/, "", name)
  next
}
{
  low = $need("relative_density_at_low_stress")
  high = $need("relative_density_at_high_stress")
  if (FNR > 2)
    printf "%s,%d,%.6g,%.8g,%.8g,%.6g,%.6g,%.6g,%.6g\n", name, FNR - 2, $need("loop_area"), low, high, low - low_before, high - high_before, \
           $need("plastic_dissipation"), $need("damage_dissipation")
  low_before = low
  high_before = high
}
END { exit failed }
