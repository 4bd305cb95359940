# awk -f ../common/verdict.awk -f strength.awk -v label=LAW,G,K history.csv: peak tension of the last stage, where, and
# what the bonds had spent.
BEGIN { FS = "," }
NR == 1 { read_header(); next }
$column["stage"] == 3 {
  if (!start) { start = $column["box_lengths_2"]; mean_damage = $column["mean_damage"] }
  tension = -0.5 * ($column["wall_stress_4"] + $column["wall_stress_5"])
  if (tension > peak) { peak = tension; at = $column["box_lengths_2"] / start - 1; damage = $column["mean_damage"] }
  last = tension
  residual = $column["energy_residual"] / $column["external_work"]
  dissipated = $column["damage_dissipation"]
}
END {
  printf "%s,%.4f,%.5f,%.4f,%.4f,%.4e,%.4f,%.2e\n", label, peak, at, mean_damage, damage, dissipated, last, residual
}
