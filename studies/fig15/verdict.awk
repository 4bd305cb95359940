# awk -f ../common/verdict.awk -f ../branches/fits.awk -f verdict.awk strength.csv strength-energy-law.csv quality.csv
BEGIN { FS = "," }
$need("strength") == "" { next }
{
  n = ++rows[table]
  strength[table, n] = $need("strength")
  energy[table, n] = $need("fracture_energy")
  if (n > 1 && $need("strength") < 0.99 * strength[table, n - 1]) not_rising[table] = 1
  if ($need("fall_after_peak") < 0.02) next
  ++peaks[table]
  ratio = $need("onset_stress") / $need("strength")
  onsets[table] = onsets[table] sprintf("%s%.2f", (peaks[table] > 1 ? ", " : ""), ratio)
  if (peaks[table] == 1 || ratio < least[table]) least[table] = ratio
}
function judge(law, name,   n) {
  n = rows[law]
  statement("The peak rises with the bonds' fracture energy" name, "rises", \
            sprintf("%.3g MPa at %s N/mm, %.3g MPa at %s N/mm", strength[law, 1], energy[law, 1], strength[law, n], energy[law, n]), \
            strength[law, n] > strength[law, 1] + 0 && !not_rising[law], (not_rising[law] ? "not from each energy to the next" : "from each energy to the next") "; differences below 1 % count as none: where bonds hold, the grains yield and the energy no longer matters")
  statement("Every curve has a peak and falls after it" name, "peak", peaks[law] + 0 " of " n " fall by 2 % or more within the test", peaks[law] == n, \
            "the test ends at a fall of 10 % or an axial strain of 0.15")
  statement("Failure comes with the onset of damage growth" name, "coincide", "stress at the onset over the peak: " onsets[law], (peaks[law] ? least[law] >= 0.9 : -1), \
            "onset: steepest tangent of the damage dissipation carried back to its start (docs/metrics.md); samples that fall by 2 % or more; taken as agreement: at least 0.9")
}
END {
  if (failed) exit 1
  judge(1, "")
  judge(2, " (softening law energy)")
  quality_statements()
  end_of_verdict()
}
