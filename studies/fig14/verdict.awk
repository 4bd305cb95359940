# awk -f ../common/verdict.awk -f ../branches/fits.awk -f verdict.awk contacts.csv before-D.csv... damage-D.csv...
# Sections: cut boundaries of grains, damage at both ends of each segment, -1 where there is no bond.
BEGIN { FS = "," }
table == 1 {
  ++n
  mean_before[n] = $need("mean_damage")
  mean_after[n] = $need("mean_damage_at_end")
  density[n] = sprintf("%.2f", $need("relative_density_max"))
  dissipated[n] = $need("damage_dissipation_at_end") / $need("damage_dissipation")
  next
}
$need("damage_1") >= 0 && $need("damage_2") >= 0 {
  d = ($need("damage_1") + $need("damage_2")) / 2
  bonded[table] += $need("length")
  sum[table] += d * $need("length")
  if (d > 0.99) broken[table] += $need("length")
}
END {
  if (failed) exit 1
  texts = shares = bulk = ""
  grows = contrast = 1
  for (i = 1; i <= n; ++i) {
    b = bonded[1 + i] ? broken[1 + i] / bonded[1 + i] : 0
    a = bonded[1 + n + i] ? broken[1 + n + i] / bonded[1 + n + i] : 0
    texts = texts sprintf("%sD_max %s: %.0f %% before, %.0f %% after", (i > 1 ? "; " : ""), density[i], 100 * b, 100 * a)
    bulk = bulk sprintf("%sD_max %s: mean damage %.3f to %.3f, dissipation times %.2f", (i > 1 ? "; " : ""), density[i], mean_before[i], mean_after[i], dissipated[i])
    if (a <= b) grows = 0
    if (b > 0.5) contrast = 0
  }
  statement("Bonds on the section are damaged further while the sample fails: share of their length with D > 0.99", "damage spreads to the peak", texts, grows, bulk)
  statement("Damage marks bands from top to bottom, so most bonds outside are sound before the sample is loaded", "shear-like bands", texts, \
            (mesh == "smoke" && contrast ? -1 : contrast), \
            "taken as the condition for bands to be visible: at most half of the bonded length with D > 0.99 before. With the law 'exponential' damage is near 1 at separations far below those of failure (docs/numerics.md); law 'energy' keeps it small")
  end_of_verdict()
}
