# awk -f ../common/verdict.awk -f ../branches/fits.awk -f verdict.awk density.csv modulus.csv fits.json quality.csv
BEGIN { FS = "," }
$need("recovery") == "" { next }
table == 1 {
  ++n
  if (n > 1 && $need("recovery") <= last) rising = -1
  if (n == 1) first = $need("recovery")
  last = $need("recovery")
  lowest_density = n == 1 ? $need("relative_density_max") : lowest_density
}
table == 2 {
  ++m
  if (m > 1 && $need("recovery") >= previous) not_falling = 1
  previous = $need("recovery")
  if (m == 1) softest = previous
  stiffest = previous
}
END {
  if (failed) exit 1
  two = fit_of("bilinear", "relative_density_max", "recovery")
  one = fit_of("linear", "relative_density_max", "recovery")
  power = fit_of("log-log", "youngs_modulus", "recovery")
  statement("Elastic recovery grows with the maximum relative density", "grows", \
            sprintf("%.2f %% at D_max = %.2f, %.2f %% at 0.92; slope of one line %s", 100 * first, lowest_density, 100 * last, interval(one, "b", "%.3f")), \
            last > first && fit_low[one, "b"] > 0, \
            (rising < 0 ? "not from each density to the next" : "from each density to the next") "; taken as agreement: a line through all points rises, its 95 % interval too")
  statement("Two lines describe it, meeting at a relative density of about 0.859", "0.859", interval(two, "kink", "%.3f"), \
            fit_low[two, "kink"] <= 0.859 && fit_high[two, "kink"] >= 0.859, \
            sprintf("R^2 %.3f of two lines, %.3f of one; interval: kinks that fit as well but for chance", fit_r2[two], fit_r2[one]))
  statement("The line above the kink is the steeper one", "steeper above", \
            "slope " interval(two, "slope_below", "%.3f") " below, " interval(two, "slope_above", "%.3f") " above", \
            fit_value[two, "slope_above"] > fit_value[two, "slope_below"], "")
  statement("Recovery falls with the grains' Young's modulus, a straight line in log-log", "straight line, falling", \
            sprintf("R_E ~ E^b with b = %s, R^2 = %.4f; %.2f %% at 3 GPa, %.2f %% at 8 GPa", interval(power, "b", "%.3f"), fit_r2[power], \
                    100 * softest, 100 * stiffest), \
            fit_r2[power] >= 0.98 && fit_high[power, "b"] < 0 && !not_falling, "taken as agreement: R^2 of at least 0.98 and falling throughout")
  quality_statements()
  end_of_verdict()
}
