# awk -f ../common/verdict.awk -f verdict.awk stress-path.csv
BEGIN { FS = "," }
FNR == 1 { read_header(); next }
{
  p = $need("mean_stress_MPa")
  q = $need("deviatoric_stress_MPa")
  part = $need("part")
}
part == "loading" { ++n_loading; p_of[n_loading] = p; q_of[n_loading] = q; p_max = p }
part == "unloading" { p_low = p; q_low = q; if (absolute(q) > unloading) unloading = absolute(q) }
part == "test" {
  ++n; sp += p; sq += q; spp += p * p; spq += p * q
  p_end = p; q_end = q
}
END {
  if (failed) exit 1
  if (n < 2) { print "verdict: no test in the path" > "/dev/stderr"; exit 1 }
  # Before, when grains still move past one another, a packing's few contacts decide.
  for (i = 1; i <= n_loading; ++i) if (p_of[i] > p_max / 4 && absolute(q_of[i] / p_of[i]) > loading) loading = absolute(q_of[i] / p_of[i])
  slope = (n * spq - sp * sq) / (n * spp - sp * sp)
  statement("Loading and unloading are isotropic: they follow the p axis", "q = 0 (drawn)", \
            sprintf("|q| at most %.1f %% of p in loading from a quarter of the largest p on, at most %.1f MPa in unloading from %.0f MPa", 100 * loading, unloading, p_max), \
            loading <= 0.1 && unloading <= 0.05 * p_max, \
            "walls move alike, so a packing's own anisotropy shows as q; taken as agreement: 10 % of p, and 5 % of the largest p")
  statement("Unloading ends at the confining stress", "about 8 MPa", sprintf("%.2f MPa", p_low), absolute(p_low - 8) <= 0.4, "taken as agreement: 5 %")
  statement("Axial compression at constant lateral force climbs along a straight line of slope 3", "dq/dp = 3 for a constant lateral stress", \
            sprintf("%.2f, to p = %.1f MPa, q = %.1f MPa", slope, p_end, q_end), absolute(slope - 3) <= 0.15, \
            "taken as agreement: 5 %; the lateral stress is not quite constant, since the lateral faces change while the force stays")
  end_of_verdict()
}
