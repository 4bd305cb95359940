# awk -f ../common/verdict.awk -f ../branches/fits.awk -f verdict.awk contacts.csv before-NAME.csv... damage-NAME.csv...
# Sections: cut boundaries of grains, damage at both ends of each segment, -1 where there is no bond.
BEGIN { FS = "," }
table == 1 {
  ++n
  law[n] = $1 ~ /^energy/ ? "energy" : "exponential"
  density[n] = sprintf("%.2f", $need("relative_density_max"))
  bulk[n] = sprintf("mean damage of all bonds %.3f to %.3f, dissipation times %.2f", $need("mean_damage"), $need("mean_damage_at_end"), \
                    $need("damage_dissipation_at_end") / $need("damage_dissipation"))
  next
}
$need("damage_1") >= 0 && $need("damage_2") >= 0 {
  bonded[table] += $need("length")
  d = ($need("damage_1") + $need("damage_2")) / 2
  sum[table] += d * $need("length")
  if (d > 0.5) broken[table] += $need("length")
}
function judge(name,   i, b, a, text, shares, note, spreads, contrast, first) {
  spreads = contrast = 1
  for (i = 1; i <= n; ++i)
    if (law[i] == name) {
      b = bonded[1 + i] ? sum[1 + i] / bonded[1 + i] : 0
      a = bonded[1 + n + i] ? sum[1 + n + i] / bonded[1 + n + i] : 0
      text = text sprintf("%sD_max %s: %.4f to %.4f", (first ? "; " : ""), density[i], b, a)
      note = note sprintf("%sD_max %s: %s", (first ? "; " : ""), density[i], bulk[i])
      if (a <= b) spreads = 0
      a = bonded[1 + n + i] ? broken[1 + n + i] / bonded[1 + n + i] : 0
      b = bonded[1 + i] ? broken[1 + i] / bonded[1 + i] : 0
      shares = shares sprintf("%sD_max %s: %.0f to %.0f %%", (first ? "; " : ""), density[i], 100 * b, 100 * a)
      if (b > 0.5 || a > 0.9 || a < 0.02) contrast = 0
      first = 1
    }
  statement("Damage grows while the sample fails: mean damage of the bonds on the section before and after (softening law " name ")", "damage at the peak", \
            text, spreads, note)
  statement("Damage stands out as bands from top to bottom: bonded length with D > 0.5 before and after (softening law " name ")", "shear-like bands", \
            shares, (contrast ? -1 : 0), \
            contrast ? "sound and broken bonds stand side by side, as bands need; whether they are bands is for the eye" : \
            name == "exponential" ? "no contrast: this law damages a bond nearly all the way at separations of some 1e-5 mm, which unloading exceeds everywhere (docs/numerics.md)" : \
            "no contrast: with this law hardly a bond breaks, the sample yields within the test instead of failing")
}
END {
  if (failed) exit 1
  judge("exponential")
  judge("energy")
  end_of_verdict()
}
