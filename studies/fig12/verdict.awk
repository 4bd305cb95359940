# awk -f ../common/verdict.awk -f ../branches/fits.awk -f verdict.awk modulus.csv fits.json quality.csv
BEGIN { FS = "," }
table == 1 && $need("modulus_over_grains") == "" { ++missing; next }
table == 1 {
  ++n
  if (n > 1 && $need("modulus_over_grains") <= last) not_rising = 1
  if (n == 1) first = $need("modulus_over_grains")
  last = $need("modulus_over_grains")
}
END {
  if (failed) exit 1
  s = fit_of("spriggs", "relative_density_max", "modulus_over_grains")
  statement("The compact's Young's modulus grows with the maximum relative density", "grows", \
            sprintf("E_p/E = %.3f to %.3f, %s", first, last, not_rising ? "not from each density to the next" : "from each density to the next"), \
            last > first && fit_high[s, "a"] > 0 && fit_low[s, "a"] > 0, missing ? missing " samples without a modulus" : "")
  statement("It is exponential in the porosity: ln(E_p/E) = b - a P", "exponential", \
            sprintf("a = %s, R^2 = %.3f of ln(E_p/E)", interval(s, "a", "%.2f"), fit_r2[s]), fit_r2[s] >= 0.9, "taken as agreement: R^2 of at least 0.9; the paper's R^2 is not in its text")
  e = exp(fit_value[s, "b"])
  statement("The fitted curve does not pass through E_p = E at zero porosity", "does not", \
            sprintf("E_p/E = %.3f [%.3f, %.3f] at P = 0", e, exp(fit_low[s, "b"]), exp(fit_high[s, "b"])), \
            exp(fit_low[s, "b"]) > 1 || exp(fit_high[s, "b"]) < 1, "how far off the paper's is cannot be read from its text")
  quality_statements()
  end_of_verdict()
}
