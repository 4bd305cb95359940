# awk -f errors.awk reference.csv curve.csv
# How far a computed curve is from the reference: loading (mean and largest, from a fifth of the largest approach on, in
# parts of the reference), unloading (root mean square down to the reference's pull-off, in parts of the range of forces),
# pull-off force (in parts of the reference's).

BEGIN { FS = "," }

FNR == 1 { ++file; next }

file == 1 {
  h = $4
  if ($1 == "hertz") { ++n; load_h[n] = h; load_f[n] = $3; if ($3 > top) top = $3 }
  else { ++m; away_h[m] = h; away_f[m] = $3; if ($3 < lowest) { lowest = $3; lowest_h = h } }
}

# Reference force at an approach; the arrays run in either direction.
function on_loading(h,   i) {
  for (i = 2; i <= n; ++i)
    if (h <= load_h[i]) return load_f[i - 1] + (load_f[i] - load_f[i - 1]) * (h - load_h[i - 1]) / (load_h[i] - load_h[i - 1])
  return load_f[n] + (load_f[n] - load_f[n - 1]) * (h - load_h[n]) / (load_h[n] - load_h[n - 1])
}
function on_unloading(h,   i) {
  for (i = 2; i <= m; ++i)
    if (h >= away_h[i]) return away_f[i - 1] + (away_f[i] - away_f[i - 1]) * (h - away_h[i - 1]) / (away_h[i] - away_h[i - 1])
  return away_f[m]
}

file == 2 && $1 == "loading" {
  if ($2 > largest_h) largest_h = $2
  ++rows
  row_h[rows] = $2
  row_f[rows] = $3
}
file == 2 && $1 == "unloading" {
  # Beyond the end of the reference's branch two free bodies ring.
  if ($2 >= away_h[m] && $3 < pull_off) { pull_off = $3; pull_off_h = $2 }
  if (m && $2 >= lowest_h) {
    d = ($3 - on_unloading($2)) / (top - lowest)
    squares += d * d
    ++counted
  }
}

END {
  for (i = 1; i <= rows; ++i)
    if (row_h[i] >= 0.2 * largest_h) {
      d = row_f[i] / on_loading(row_h[i]) - 1
      if (d < 0) d = -d
      sum += d
      if (d > most) most = d
      ++used
    }
  printf "loading_mean_error,loading_largest_error,unloading_error,pull_off [E R^2],pull_off_over_reference,approach_at_pull_off [R],reference_approach [R]\n"
  printf "%.5f,%.5f,%.5f,%.6e,%.5f,%.6e,%.6e\n", sum / used, most, (counted ? sqrt(squares / counted) : 0), pull_off, \
         (lowest < 0 ? pull_off / lowest : 0), pull_off_h, lowest_h
}
