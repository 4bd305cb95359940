# awk -f ../common/verdict.awk -f ../branches/fits.awk -f verdict.awk energy.csv energy-energy-law.csv energy-energy-law-dense.csv fits.json
BEGIN { FS = "," }
$need("modulus") != "" { modulus[table, ++moduli[table]] = $need("modulus") }
table < 3 && $need("strength") != "" {
  n = ++rows[table]
  strength[table, n] = $need("strength")
  if (n > 1 && $need("strength") < 0.99 * strength[table, n - 1]) not_rising[table] = 1 # differences below 1 % count as none
}
function judge(law, name,   e, g, i) {
  e = fit_of("inverse-exponential", "fracture_energy", "modulus", law)
  g = fit_of("exponential", "fracture_energy", "strength", law)
  i = fit_of("inverse-exponential", "fracture_energy", "strength", law)
  statement("The compact's Young's modulus grows with fracture energy and saturates, an inverse exponential" name, "saturates", \
            sprintf("%.3g to %.3g MPa; R^2 = %.3f, A / MPa = %s, C / (N/mm) = %s", modulus[law, 1], modulus[law, moduli[law]], fit_r2[e], \
                    interval(e, "A", "%.4g"), interval(e, "C", "%.3g")), \
            modulus[law, moduli[law]] > modulus[law, 1] + 0 && fit_r2[e] >= 0.9 && fit_value[e, "B"] > 0 && fit_value[e, "C"] < 0.5, \
            "taken as agreement: rising, R^2 of at least 0.9, decay within the range of energies")
  statement("Its saturated value is 2312.73 MPa" name, "2312.73 MPa", interval(e, "A", "%.4g"), \
            fit_points[e] && fit_value[e, "A"] > 0.9 * 2312.73 && fit_value[e, "A"] < 1.1 * 2312.73, \
            "the paper does not say at which D_max; taken as agreement: within 10 %, half of what one modulus is uncertain by")
  if (law > 2) return
  statement("Strength rises with fracture energy as A exp(B G^c)" name, "exponential", \
            sprintf("%.3g to %.3g MPa; R^2 = %.3f, B = %s mm/N", strength[law, 1], strength[law, rows[law]], fit_r2[g], interval(g, "B", "%.3g")), \
            !not_rising[law] && fit_low[g, "B"] > 0 && fit_r2[g] >= 0.9, "taken as agreement: rising throughout and R^2 of at least 0.9")
  statement("Strength rises with fracture energy by the same kind of curve as E_p, an inverse exponential" name, "fits alike", \
            sprintf("R^2 = %.3f, A = %s MPa, C = %s N/mm", fit_r2[i], interval(i, "A", "%.3g"), interval(i, "C", "%.3g")), \
            !not_rising[law] && fit_r2[i] >= 0.9, "the text says of both fits of Fig. 16 that they are of one kind")
}
END {
  if (failed) exit 1
  judge(1, " (D_max = 0.77)")
  judge(2, " (D_max = 0.77, softening law energy)")
  judge(3, " (D_max = 0.92, softening law energy)")
  end_of_verdict()
}
