# awk -f ../common/verdict.awk -f row.awk -v name=NAME -v code=EXIT_CODE -v log_file=FILE cases.csv history.csv: one
# line of summary.csv. The residual is divided by the largest term of the balance so far. Rows in which that term is
# below a millionth of the run's energy show only rounding and are left out (also those before the walls touch a grain).
BEGIN {
  FS = ","
  terms = "external_work kinetic_energy elastic_energy plastic_dissipation damage_dissipation bond_energy" \
          " contact_energy viscous_dissipation damping_dissipation"
}
FNR == 1 { ++file; if (file == 2) read_header(); next }
file == 1 { if ($1 == name) { what = $2; expected = $5 }; next }
/nan|inf/ { ++not_finite }
{
  for (i in term) delete term[i]
  n = split(terms, term, " ")
  for (i = 1; i <= n; ++i) if (absolute($need(term[i])) > largest) largest = absolute($column[term[i]])
  size[++rows] = largest
  residual[rows] = absolute($need("energy_residual"))
  if ($need("max_penetration") > penetration) penetration = $column["max_penetration"]
  density = $need("relative_density")
  stress = $need("mean_stress")
  step = $need("step")
  internal = $column["elastic_energy"] + $column["plastic_dissipation"]
  ratio = internal > 0 ? $column["kinetic_energy"] / internal : 0
}
END {
  if (failed) exit 1
  for (i = 1; i <= rows; ++i)
    if (size[i] > 1e-6 * largest && residual[i] / size[i] > worst) worst = residual[i] / size[i]
  while ((getline line < log_file) > 0)
    if (match(line, /(warning|error): /)) {
      sub(/; history and last state.*/, "", line)
      message = substr(line, RSTART)
    }
  gsub(/,/, ";", message)
  gsub(/"/, "", message)
  printf "%s,%s,%s,%d,%d,%.4f,%.5g,%.2e,%.2e,%.4f,%d,%s\n", name, what, expected, code, step, density, stress, \
         worst, ratio, penetration, not_finite, message
}
