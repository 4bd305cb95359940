# awk -f ../common/verdict.awk -f quality.awk BRANCH/curve.csv...: how quasi-static the last stage of each is, over the rows in which
# the axial stress exceeds a fifth of its largest value and, where it rises, up to that value.
BEGIN { FS = ","; print "name,kinetic_over_internal [1],kinetic_over_elastic [1],imbalance [1],residual_over_work [1]" }
FNR == 1 {
  finish()
  split("", column)
  read_header()
  name = FILENAME
  sub(/\/curve\.csv$/, "", name)
  sub(/^.*\//, "", name)
  last = -1
  first = 1
  next
}
first {
  first = 0
  start_work = $need("external_work")
  start_residual = $need("energy_residual")
}
{
  if ($need("stage") > last) { last = $need("stage"); rows = 0 }
  ++rows
  upper = $need("wall_stress_5")
  lower = $need("wall_stress_4")
  axial[rows] = (upper + lower) / 2
  difference[rows] = absolute(upper - lower)
  elastic[rows] = $need("elastic_energy")
  plastic[rows] = $need("plastic_dissipation")
  kinetic[rows] = $need("kinetic_energy")
  residual[rows] = $need("energy_residual") - start_residual
  work = absolute($need("external_work") - start_work)
  if (rows == 1 || work > largest_work) largest_work = work
}
END { finish() }

function finish(   i, top, peak, ratio, worst, worst_elastic, worst_residual, sum, stress) {
  for (i = 1; i <= rows; ++i) if (axial[i] > top) { top = axial[i]; peak = i }
  for (i = 1; i <= rows; ++i) {
    if (absolute(residual[i]) > worst_residual) worst_residual = absolute(residual[i])
    if (axial[i] < top / 5 || (i > peak && peak > rows / 10)) continue
    ratio = kinetic[i] / (elastic[i] + plastic[i])
    if (ratio > worst) worst = ratio
    ratio = kinetic[i] / elastic[i]
    if (ratio > worst_elastic) worst_elastic = ratio
    sum += difference[i]
    stress += axial[i]
  }
  if (rows) printf "%s,%.3g,%.3g,%.3g,%.3g\n", name, worst, worst_elastic, (stress > 0 ? sum / stress : 0), worst_residual / largest_work
  rows = 0
}
