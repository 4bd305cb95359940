# awk -f ../common/verdict.awk -f ../branches/fits.awk -f verdict.awk energy.csv fits.json
BEGIN { FS = "," }
table == 1 {
  if ($need("modulus") != "") {
    ++n
    if (n == 1) first = $need("modulus")
    last = $need("modulus")
    uncertainty = $need("modulus_uncertainty")
  }
  if ($need("strength") != "") {
    ++m
    if (m > 1 && $need("strength") <= last_strength) not_rising = 1
    if (m == 1) first_strength = $need("strength")
    last_strength = $need("strength")
  }
}
END {
  if (failed) exit 1
  e = fit_of("inverse-exponential", "fracture_energy", "modulus")
  g = fit_of("exponential", "fracture_energy", "strength")
  i = fit_of("inverse-exponential", "fracture_energy", "strength")
  statement("The compact's Young's modulus grows with fracture energy and saturates, an inverse exponential", "saturates", \
            sprintf("%.3g to %.3g MPa; R^2 = %.3f, A = %s MPa, C = %s N/mm", first, last, fit_r2[e], interval(e, "A", "%.4g"), interval(e, "C", "%.3g")), \
            last > first && fit_r2[e] >= 0.9 && fit_value[e, "C"] < 0.5, \
            "taken as agreement: rising, R^2 of at least 0.9, decay within the range of energies")
  statement("Its saturated value is 2312.73 MPa", "2312.73 MPa", interval(e, "A", "%.4g") " MPa", \
            fit_low[e, "A"] <= 2312.73 && fit_high[e, "A"] >= 2312.73, "the paper does not say at which D_max; here it is 0.77")
  statement("Strength rises exponentially with fracture energy", "exponential rise", \
            sprintf("%.3g to %.3g MPa; A exp(B G): R^2 = %.3f, B = %s mm/N", first_strength, last_strength, fit_r2[g], interval(g, "B", "%.3g")), \
            !not_rising && fit_low[g, "B"] > 0 && fit_r2[g] >= 0.9, \
            sprintf("taken as agreement: rising throughout and R^2 of at least 0.9; the text also likens it to the inverse exponential of E_p, whose R^2 is %.3f here", fit_r2[i]))
  end_of_verdict()
}
