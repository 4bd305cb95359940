# A section's polygons in ascending von Mises stress (tet, grain, von_mises, area, u, v) -> one row: area-weighted mean and
# percentiles. -v label=TEXT -v density=D -v yield_stress=MPa.
BEGIN { FS = "," }
$4 + 0 > 0 { stress[++n] = $3; area[n] = $4; total += $4; moment += $3 * $4; if ($3 > yield_stress) yielding += $4 }
function percentile(share,   i, sum) {
  for (i = 1; i <= n; ++i) {
    sum += area[i]
    if (sum >= share * total) return stress[i]
  }
  return stress[n]
}
END {
  if (!n) {
    print "percentiles: an empty section" > "/dev/stderr"
    exit 1
  }
  printf "%s,%s,%.6g,%.6g,%.6g,%.6g,%.6g,%.6g\n", label, density, moment / total, percentile(0.5), percentile(0.95), \
         percentile(0.99), stress[n], yielding / total
}
