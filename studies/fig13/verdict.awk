# awk -f ../common/verdict.awk -f ../branches/fits.awk -f verdict.awk strength.csv strength-energy-law.csv fits.json quality.csv
BEGIN { FS = "," }
$need("strength") == "" { next }
{
  n = ++rows[table]
  strength[table, n] = $need("strength")
  if (n > 1 && $need("strength") <= strength[table, n - 1]) not_rising[table] = 1
  if ($need("fall_after_peak") < 0.02) ++no_peak[table]
}
# Where no sample fails within the test, its largest stresses are no strengths, and what fits them says nothing of the paper's.
function judged(law, agrees) { return no_peak[law] == rows[law] ? -1 : agrees }
function judge(law, name,   r, f, a, n, last) {
  n = rows[law]
  last = strength[law, n]
  r = fit_of("ryshkewitch-duckworth", "relative_density_max", "strength", law)
  f = fit_of("rumpf", "relative_density_max", "strength", law)
  a = fit_of("log-log", "contact_area_max", "strength", law)
  statement("Unconfined strength grows with the maximum relative density" name, "grows", \
            sprintf("%.3g to %.3g MPa over %d samples", strength[law, 1], last, n), judged(law, last > strength[law, 1] + 0), \
            (not_rising[law] ? "not from each density to the next; " : "from each density to the next; ") \
            (no_peak[law] == rows[law] ? "not judged, since none falls by 2 % within the test" : no_peak[law] ? no_peak[law] " samples fall by less than 2 % within the test" : "all samples have a peak"))
  statement("Ryshkewitch and Duckworth's sigma_0 exp(-B P) fits it" name, "R^2 = 0.996", \
            sprintf("R^2 = %.3f of %d points; sigma_0 = %s MPa, B = %s", fit_r2[r], fit_points[r], interval(r, "sigma_0", "%.3g"), interval(r, "B", "%.3g")), \
            judged(law, fit_r2[r] >= 0.98), "taken as agreement: R^2 of at least 0.98")
  statement("Rumpf's equation fits worse" name, "deviates", sprintf("R^2 = %.3f against %.3f", fit_r2[f], fit_r2[r]), judged(law, fit_r2[f] < fit_r2[r]), "Rumpf's equation has one coefficient, the other two")
  statement("Strength over contact-area ratio is a straight line in log-log" name, "linear", \
            sprintf("strength ~ (area ratio)^b, b = %s, R^2 = %.3f of the logarithms", interval(a, "b", "%.2f"), fit_r2[a]), judged(law, fit_r2[a] >= 0.95), \
            "taken as agreement: R^2 of at least 0.95; area ratio at D_max")
}
END {
  if (failed) exit 1
  judge(1, "")
  judge(2, " (softening law energy)")
  quality_statements()
  end_of_verdict()
}
