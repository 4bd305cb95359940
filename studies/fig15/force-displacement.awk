# awk -f force-displacement.awk G-D-unconfined/curve.csv...: force of the upper plate over the approach of the two plates.
BEGIN { FS = ","; print "fracture_energy [N/mm],displacement [mm],force [N],damage_dissipation [mJ]" }
FNR == 1 {
  energy = FILENAME
  sub(/^.*\/(energy-)?g/, "", energy)
  sub(/-D.*$/, "", energy)
  split("", at)
  for (i = 1; i <= NF; ++i) {
    name = $i
    sub(/ *\[.*$/, "", name)
    at[name] = i
  }
  begun = 0
  next
}
$at["stage"] < 1 { height = $at["box_lengths_2"]; next }
{
  if (!begun) { begun = 1; damage = $at["damage_dissipation"] }
  printf "%s,%.6g,%.6g,%.6g\n", energy, height - $at["box_lengths_2"], $at["wall_stress_5"] * $at["box_lengths_0"] * $at["box_lengths_1"], \
         $at["damage_dissipation"] - damage
}
