# awk -f rotations.awk rotations-*.csv: error of the contact force over orientations, a row for each mesh, approach and
# contact. The approach of each contact is that which it came to; errors are against the reference there.
BEGIN {
  FS = OFS = ","
  print "element,scaling,size_ratio,nominal_approach,contact,contacts,mean_error,standard_deviation,smallest,largest," \
        "largest_kinetic_over_elastic"
}
FNR == 1 { next }
{
  key = $1 OFS $2 OFS $3 OFS $5 OFS $6
  if (!(key in count)) order[++keys] = key
  if (!(key in count) || $9 < low[key]) low[key] = $9
  if (!(key in count) || $9 > high[key]) high[key] = $9
  if ($10 > kinetic[key]) kinetic[key] = $10
  ++count[key]
  sum[key] += $9
  square[key] += $9 * $9
}
END {
  for (i = 1; i <= keys; ++i) {
    k = order[i]
    mean = sum[k] / count[k]
    deviation = count[k] > 1 ? sqrt((square[k] - count[k] * mean * mean) / (count[k] - 1)) : 0
    printf "%s,%d,%.4f,%.4f,%.4f,%.4f,%.1e\n", k, count[k], mean, deviation, low[k], high[k], kinetic[k]
  }
}
