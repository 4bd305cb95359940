# awk -f unequal.awk unequal-*.csv: pairs of unequal meshes. Error of the pair's force over all seeds, largest
# difference when the grains are listed the other way round, largest resultant of all contact forces.
BEGIN {
  FS = OFS = ","
  print "element,lower,upper,nominal_approach,contacts,mean_error,standard_deviation,largest_change_by_order," \
        "largest_net_force,largest_net_moment"
}
FNR == 1 || $9 != "pair" { next }
{
  key = $1 OFS $2 OFS $3 OFS $8
  if (!(key in seen)) { seen[key] = 1; order[++keys] = key }
  if ($6 > force[key]) force[key] = $6
  if ($7 > moment[key]) moment[key] = $7
  if ($4 == "bottom") {
    ++count[key]
    sum[key] += $12
    square[key] += $12 * $12
    first[key, $5] = $11
  } else {
    change = $11 / first[key, $5] - 1
    if (change < 0) change = -change
    ++exchanged[key]
    if (change > largest[key]) largest[key] = change
  }
}
END {
  for (i = 1; i <= keys; ++i) {
    k = order[i]
    mean = sum[k] / count[k]
    deviation = count[k] > 1 ? sqrt((square[k] - count[k] * mean * mean) / (count[k] - 1)) : 0
    printf "%s,%d,%.4f,%.4f,%s,%.0e,%.0e\n", k, count[k], mean, deviation, \
           exchanged[k] ? sprintf("%.0e", largest[k]) : "-", force[k], moment[k]
  }
}
