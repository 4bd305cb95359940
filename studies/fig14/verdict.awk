# awk -f ../common/verdict.awk -f ../branches/fits.awk -f verdict.awk contacts.csv before-NAME.csv... damage-NAME.csv...
# Sections: cut boundaries of grains, damage at both ends of each segment, -1 where there is no bond.
BEGIN { FS = "," }
table == 1 {
  ++n
  law[n] = $1 ~ /^energy/ ? "energy" : "exponential"
  density[n] = sprintf("%.2f", $need("relative_density_max"))
  before[n] = $need("mean_damage")
  after[n] = $need("mean_damage_at_end")
  dissipated[n] = $need("damage_dissipation_at_end") / $need("damage_dissipation")
  next
}
$need("damage_1") >= 0 && $need("damage_2") >= 0 {
  bonded[table] += $need("length")
  d = ($need("damage_1") + $need("damage_2")) / 2
  i = (table - 2) % n + 1
  if (d > threshold(law[i])) broken[table] += $need("length")
}
# Beyond it a bond counts as opened: the law exponential has every bond at 0.99 before the test; 0.998 is a separation of 5e-3 mm.
function threshold(name) { return name == "exponential" ? 0.998 : 0.5 }
function judge(name,   i, b, a, text, shares, spreads, contrast, first) {
  spreads = contrast = 1
  for (i = 1; i <= n; ++i)
    if (law[i] == name) {
      text = text sprintf("%sD_max %s: %.4f to %.4f, dissipation times %.2f", (first ? "; " : ""), density[i], before[i], after[i], dissipated[i])
      if (after[i] <= before[i] || dissipated[i] <= 1) spreads = 0
      a = bonded[1 + n + i] ? broken[1 + n + i] / bonded[1 + n + i] : 0
      b = bonded[1 + i] ? broken[1 + i] / bonded[1 + i] : 0
      shares = shares sprintf("%sD_max %s: %.0f to %.0f %%", (first ? "; " : ""), density[i], 100 * b, 100 * a)
      if (a > 0.95 || a < 0.02) contrast = 0
      first = 1
    }
  statement("Damage grows while the sample fails: mean damage of all bonds, and what they have dissipated, before and after (softening law " name ")", "damage at the peak", \
            text, spreads, "both have to grow; the mean may fall since bonds that form in the test count as well")
  statement("Damage stands out as bands from top to bottom: bonded length with D > " threshold(name) " before and after (softening law " name ")", "shear-like bands", \
            shares, (contrast ? -1 : 0), \
            contrast ? "opened and other bonds stand side by side, as bands need; whether they are bands is for the eye, on more grains than MESH=smoke has" : \
            name == "exponential" ? "no contrast on the section between opened and other bonds" : \
            "no contrast: with this law hardly a bond breaks, the sample yields within the test instead of failing")
}
END {
  if (failed) exit 1
  judge("exponential")
  judge("energy")
  end_of_verdict()
}
