# awk -f errors.awk -v hardening=power|total_strain finite-elements.csv similarity.csv curve.csv
# How far a computed curve is from the converged finite-element rows (loading, from a quarter of the largest approach on) and
# from the similarity law: loading, unloading down to the law's pull-off (root mean square, in parts of the law's range of
# forces), pull-off.
BEGIN { FS = "," }
FNR == 1 { ++file; next }
file == 1 { ++n; h[n] = $1; f[n] = hardening == "power" ? $2 : $3; next }
file == 2 {
  if ($3 > top) top = $3
  if ($3 < lowest) { lowest = $3; lowest_h = $2 }
  if ($1 == "loading") { ++m; law_h[m] = $2; law_f[m] = $3 }
  else { ++away; away_h[away] = -$2; away_f[away] = $3 } # approaches fall: between() wants them rising
  next
}
$1 == "loading" { ++rows; row_h[rows] = $2; row_f[rows] = $3; if ($2 > largest) largest = $2 }
$1 == "unloading" { if (!(unloading++) || $2 < end_h) end_h = $2; if ($3 < pull_off) { pull_off = $3; at = $2 }
  if ($2 >= lowest_h && -$2 >= away_h[1]) { d = ($3 - between(-$2, away_h, away_f, away)) / (top - lowest); squares += d * d; ++counted }
}
function between(x, xs, ys, count,   i) {
  for (i = 2; i <= count; ++i)
    if (x <= xs[i] || i == count) return ys[i - 1] + (ys[i] - ys[i - 1]) * (x - xs[i - 1]) / (xs[i] - xs[i - 1])
}
END {
  for (i = 1; i <= n; ++i)
    if (h[i] >= 0.24 * largest && h[i] <= largest * 1.001) {
      d = between(h[i], row_h, row_f, rows) / f[i] - 1
      sum += d
      if (d < 0) d = -d
      if (d > most) most = d
      ++used
      if (h[i] >= 0.0199) { e = between(h[i], row_h, row_f, rows) / between(h[i], law_h, law_f, m) - 1; if (e < 0) e = -e; if (e > law) law = e }
    }
  print "mean_error,largest_error,largest_error_similarity,pull_off [E R^2],pull_off_over_similarity,approach_at_pull_off [R],unloading_error_similarity"
  printf "%.5f,%.5f,%.5f,%.6e,%.5f,%.6e,%.5f\n", sum / used, most, law, pull_off, pull_off / lowest, at, counted ? sqrt(squares / counted) : 0
}
