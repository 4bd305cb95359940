# awk -f ../common/verdict.awk -f ../branches/fits.awk -f verdict.awk density.csv density-energy-law.csv modulus.csv fits.json quality.csv
BEGIN { FS = "," }
$need("recovery") == "" { next }
table <= 2 {
  n = ++rows[table]
  if (n > 1 && $need("recovery") <= recovery[table, n - 1]) not_rising[table] = 1
  recovery[table, n] = $need("recovery")
  density[table, n] = $need("relative_density_max")
}
table == 3 {
  ++m
  if (m > 1 && $need("recovery") >= previous) not_falling = 1
  previous = $need("recovery")
  if (m == 1) softest = previous
  stiffest = previous
}
function judge(law, name,   two, one, n) {
  n = rows[law]
  two = fit_of("bilinear", "relative_density_max", "recovery", law)
  one = fit_of("linear", "relative_density_max", "recovery", law)
  statement("Elastic recovery grows with the maximum relative density" name, "grows", \
            sprintf("%.2f %% at D_max = %.2f, %.2f %% at %.2f; slope of one line %s", 100 * recovery[law, 1], density[law, 1], 100 * recovery[law, n], \
                    density[law, n], interval(one, "b", "%.3f")), \
            recovery[law, n] > recovery[law, 1] + 0 && fit_low[one, "b"] > 0, \
            (not_rising[law] ? "not from each density to the next" : "from each density to the next") "; taken as agreement: a line through all points rises, its 95 % interval too")
  statement("Two lines describe it, meeting at a relative density of about 0.859" name, "0.859", interval(two, "kink", "%.3f"), \
            fit_points[two] ? fit_low[two, "kink"] <= 0.859 && fit_high[two, "kink"] >= 0.859 : -1, \
            sprintf("R^2 %.3f of two lines, %.3f of one, %d points; interval: kinks that fit as well but for chance", fit_r2[two], fit_r2[one], n))
  statement("The line above the kink is the steeper one" name, "steeper above", \
            "slope " interval(two, "slope_below", "%.3f") " below, " interval(two, "slope_above", "%.3f") " above", \
            fit_points[two] ? fit_value[two, "slope_above"] > fit_value[two, "slope_below"] : -1, "")
}
END {
  if (failed) exit 1
  power = fit_of("log-log", "youngs_modulus", "recovery")
  judge(1, "")
  judge(2, " (softening law energy)")
  statement("Recovery falls with the grains' Young's modulus, a straight line in log-log", "straight line, falling", \
            sprintf("R_E ~ E^b with b = %s, R^2 = %.4f; %.2f %% at 3 GPa, %.2f %% at 8 GPa", interval(power, "b", "%.3f"), fit_r2[power], \
                    100 * softest, 100 * stiffest), \
            fit_r2[power] >= 0.98 && fit_high[power, "b"] < 0 && !not_falling, "taken as agreement: R^2 of at least 0.98 and falling throughout")
  quality_statements()
  end_of_verdict()
}
