# awk -f yield.awk dissipation.csv: where the probe passes 1.003 times the dissipation at its beginning, linear between rows.
BEGIN { FS = ","; print "time_us,mean_stress_MPa,deviatoric_stress_MPa" }
FNR > 1 && $1 == "test" && !found {
  if (last && $5 >= 1.003) {
    found = 1
    t = (1.003 - last) / ($5 - last)
    printf "%.6g,%.6g,%.6g\n", time + t * ($2 - time), p + t * ($3 - p), q + t * ($4 - q)
  }
  time = $2; p = $3; q = $4; last = $5
}
