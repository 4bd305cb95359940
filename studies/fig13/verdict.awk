# awk -f ../common/verdict.awk -f ../branches/fits.awk -f verdict.awk strength.csv fits.json quality.csv
BEGIN { FS = "," }
table == 1 && $need("strength") == "" { next }
table == 1 {
  ++n
  if (n > 1 && $need("strength") <= last) not_rising = 1
  if (n == 1) first = $need("strength")
  last = $need("strength")
  if ($need("fall_after_peak") < 0.02) ++no_peak
}
END {
  if (failed) exit 1
  r = fit_of("ryshkewitch-duckworth", "relative_density_max", "strength")
  f = fit_of("rumpf", "relative_density_max", "strength")
  a = fit_of("log-log", "contact_area_max", "strength")
  statement("Unconfined strength grows with the maximum relative density from 0.62 to 0.77", "grows", \
            sprintf("%.3g to %.3g MPa over %d samples", first, last, n), last > first, \
            (not_rising ? "not from each density to the next; " : "from each density to the next; ") (no_peak ? no_peak " samples without a peak within the test" : "all samples have a peak"))
  statement("Ryshkewitch and Duckworth's sigma_0 exp(-B P) fits it", "R^2 = 0.996", \
            sprintf("R^2 = %.3f; sigma_0 = %s MPa, B = %s", fit_r2[r], interval(r, "sigma_0", "%.3g"), interval(r, "B", "%.3g")), fit_r2[r] >= 0.98, \
            "taken as agreement: R^2 of at least 0.98")
  statement("Rumpf's equation fits worse", "deviates", sprintf("R^2 = %.3f against %.3f", fit_r2[f], fit_r2[r]), fit_r2[f] < fit_r2[r], "")
  statement("Strength over contact-area ratio is a straight line in log-log", "linear", \
            sprintf("strength ~ (area ratio)^b, b = %s, R^2 = %.3f of the logarithms", interval(a, "b", "%.2f"), fit_r2[a]), fit_r2[a] >= 0.95, \
            "taken as agreement: R^2 of at least 0.95; area ratio at D_max")
  quality_statements()
  end_of_verdict()
}
