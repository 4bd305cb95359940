# awk -f ../common/verdict.awk -f ../branches/fits.awk -f verdict.awk modulus.csv modulus-energy-law.csv fits.json quality.csv
BEGIN { FS = "," }
$need("modulus_over_grains") == "" { ++missing[table]; next }
{
  n = ++rows[table]
  if (n > 1 && $need("modulus_over_grains") <= ratio[table, n - 1]) not_rising[table] = 1
  ratio[table, n] = $need("modulus_over_grains")
}
function judge(law, name,   s, e) {
  s = fit_of("spriggs", "relative_density_max", "modulus_over_grains", law)
  e = exp(fit_value[s, "b"])
  statement("The compact's Young's modulus grows with the maximum relative density" name, "grows", \
            sprintf("E_p/E = %.3f to %.3f, %s", ratio[law, 1], ratio[law, rows[law]], not_rising[law] ? "not from each density to the next" : "from each density to the next"), \
            ratio[law, rows[law]] > ratio[law, 1] + 0 && fit_low[s, "a"] > 0, missing[law] ? missing[law] " samples without a modulus" : "")
  statement("It is exponential in the porosity: ln(E_p/E) = b - a P" name, "exponential", \
            sprintf("a = %s, R^2 = %.3f of ln(E_p/E)", interval(s, "a", "%.2f"), fit_r2[s]), fit_r2[s] >= 0.9, "taken as agreement: R^2 of at least 0.9; the paper's R^2 is not in its text")
  statement("The fitted curve does not pass through E_p = E at zero porosity" name, "does not", \
            sprintf("E_p/E = %.3f [%.3f, %.3f] at P = 0", e, exp(fit_low[s, "b"]), exp(fit_high[s, "b"])), \
            exp(fit_low[s, "b"]) > 1 || exp(fit_high[s, "b"]) < 1 ? 1 : exp(fit_high[s, "b"]) - exp(fit_low[s, "b"]) > 0.1 ? -1 : 0, \
            "not judged where the interval holds 1 and is wider than 0.1; how far off the paper's is cannot be read from its text")
}
END {
  if (failed) exit 1
  judge(1, "")
  judge(2, " (softening law energy)")
  quality_statements()
  end_of_verdict()
}
