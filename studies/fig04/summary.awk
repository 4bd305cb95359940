# awk -f summary.awk cases.csv NAME.errors.csv...
# One row a case: what it is, how far its curves are from the reference, its pull-off force.
BEGIN { FS = "," }
FNR == NR { if (FNR > 1) row[$1] = $0; next }
FNR == 1 { next }
{
  name = FILENAME
  sub(/.*\//, "", name)
  sub(/\.errors\.csv$/, "", name)
  split(row[name], c, ",")
  if (!header++) print "case,series,energy [N/mm],lambda,fineness,penalty_factor,speed_factor,loading_mean_error,loading_largest_error,unloading_error,pull_off_over_jkr,strength_cap_over_jkr,element"
  # Largest tension that the bonded area can bear, sigma_0 pi a_max^2 with a_max = 1.25 a_p, over 1.5 pi w Rbar:
  # in Maugis' units (lambda/2) pi 1.25^2 (3/2)^(2/3)/1.5.
  printf "%s,%s,%s,%s,%s,%s,%s,%s,%s,%s,%s,%.5f,%s\n", name, c[2], c[3], c[4], c[5], c[6], c[7], $1, $2, $3, $5, \
         c[4] / 2 * 3.14159265 * 1.25^2 * 1.5^(2 / 3) / 1.5, c[9]
}
