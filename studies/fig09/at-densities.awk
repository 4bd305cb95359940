# awk -f ../common/verdict.awk -f at-densities.awk curve.csv: mean stress at relative densities of 0.60, 0.65 ... 0.90 and 0.92,
# between the rows beside each, so that packings can be compared. A density that was not passed has no stress.
BEGIN {
  FS = ","
  for (i = 0; i <= 6; ++i) density[++many] = 0.60 + 0.05 * i
  density[++many] = 0.92
  next_one = 1
  print "name,relative_density [1],mean_stress [MPa]"
}
/^#/ { next }
!header { read_header(); header = 1; next }
{
  d = $need("relative_density")
  p = $need("mean_stress")
  # 1e-6: a run that ends at 0.92 may end a rounding below it.
  while (next_one <= many && d >= density[next_one] - 1e-6) {
    if (before == "" && d > density[next_one] + 1e-6) { # it began denser
      printf "D%.2f,%.2f,\n", density[next_one], density[next_one]
      ++next_one
      continue
    }
    share = d > before ? (density[next_one] - before) / (d - before) : 1
    printf "D%.2f,%.2f,%.10g\n", density[next_one], density[next_one], p_before + (share > 1 ? 1 : share) * (p - p_before)
    ++next_one
  }
  before = d
  p_before = p
}
END {
  if (failed) exit 1
  for (; next_one <= many; ++next_one) printf "D%.2f,%.2f,\n", density[next_one], density[next_one]
}
