# awk -f ../common/verdict.awk -f ../branches/fits.awk -f verdict.awk release.csv curves.csv
BEGIN { FS = "," }
table == 1 {
  ++n
  keep("loaded"); keep("locked_in"); keep("locked_in_over_scale"); keep("released"); keep("released_over_scale")
  keep("damage"); keep("damage_over_scale"); keep("loaded_over_scale"); keep("damage_in_unloading")
}
function keep(name) { value[name, n] = $need(name) + 0 }
function falling(name,   i) {
  for (i = 2; i <= n; ++i) if (value[name, i] >= value[name, i - 1]) return 0
  return 1
}
# Largest over smallest.
function spread(name,   i, low, high) {
  low = high = value[name, 1]
  for (i = 2; i <= n; ++i) {
    if (value[name, i] < low) low = value[name, i]
    if (value[name, i] > high) high = value[name, i]
  }
  return low > 0 ? high / low : 0
}
function ends(name, format) { return sprintf(format " at 3 GPa, " format " at 8 GPa", value[name, 1], value[name, n]) }
END {
  if (failed) exit 1
  statement("Not normalised, the elastic energy at D_max hardly depends on the grains' Young's modulus", "no significant difference", \
            sprintf("largest over smallest %.2f: %s mJ", spread("loaded"), ends("loaded", "%.3g")), spread("loaded") <= 1.25, \
            sprintf("taken as agreement: within a factor 1.25, where E itself varies by 2.67; over E R^3 the factor is %.2f. Stresses are bounded by the same flow curve for every E, so the energy they store should fall with E", spread("loaded_over_scale")))
  statement("The energy locked in after unloading is nearly the same once divided by E R^3", "close after normalisation", \
            sprintf("largest over smallest %.2f normalised, %.2f in mJ", spread("locked_in_over_scale"), spread("locked_in")), \
            spread("locked_in_over_scale") <= 1.25, "taken as agreement: within a factor 1.25; what the paper divided by is not given as a formula (here E R^3, R the mean radius)")
  statement("Less elastic energy is released by stiffer grains", "falls with E", ends("released_over_scale", "%.4g") " over E R^3", \
            falling("released_over_scale"), "in mJ: " ends("released", "%.3g") (falling("released") ? ", falling" : ", not falling throughout"))
  statement("Less is dissipated by damage in the unloading of stiffer grains", "falls with E", ends("damage_in_unloading", "%.3g") " mJ", \
            falling("damage_in_unloading"), "since the compaction began: " ends("damage", "%.3g") " mJ" (falling("damage") ? ", falling" : ", not falling throughout") "; over E R^3 " ends("damage_over_scale", "%.3g"))
  least = 0
  for (i = 1; i <= n; ++i) {
    ratio = value["released", i] / value["damage", i]
    if (!least || ratio < least) least = ratio
  }
  statement("The release of elastic energy dominates over damage dissipation", "dominates", sprintf("at least %.2g times", least), least >= 3, \
            "taken as dominating: at least 3 times")
  end_of_verdict()
}
