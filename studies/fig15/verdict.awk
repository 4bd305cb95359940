# awk -f ../common/verdict.awk -f ../branches/fits.awk -f verdict.awk strength.csv force-displacement.csv quality.csv
BEGIN { FS = "," }
table == 1 && $need("strength") == "" { next }
table == 1 {
  ++n
  if (n > 1 && $need("strength") <= last) not_rising = 1
  if (n == 1) { first = $need("strength"); first_energy = $need("fracture_energy") }
  last = $need("strength")
  last_energy = $need("fracture_energy")
  peaks += $need("fall_after_peak") >= 0.02
  ratio = $need("onset_stress") / $need("strength")
  onsets = onsets sprintf("%s%.2f", (n > 1 ? ", " : ""), ratio)
  if (n == 1 || ratio < least) least = ratio
}
END {
  if (failed) exit 1
  statement("The peak force rises with the bonds' fracture energy", "rises", \
            sprintf("%.3g MPa at %s N/mm, %.3g MPa at %s N/mm", first, first_energy, last, last_energy), last > first && !not_rising, \
            not_rising ? "not from each energy to the next" : "from each energy to the next")
  statement("Every curve has a peak, then falls", "peak", peaks " of " n " fall by 2 % or more within the test", peaks == n, "the test ends at a fall of 10 % or an axial strain of 0.15")
  statement("Failure comes with the onset of damage growth", "coincide", "stress at the onset over the peak: " onsets, least >= 0.9, \
            "onset: steepest tangent of the damage dissipation carried back to its start (docs/metrics.md); taken as agreement: at least 0.9")
  quality_statements()
  end_of_verdict()
}
