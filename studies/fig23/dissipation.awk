# awk -f ../common/verdict.awk -f dissipation.awk stress-path.csv: plastic and damage dissipation together, over their value at
# the beginning of the probe.
BEGIN { FS = ","; print "part,time_us,mean_stress_MPa,deviatoric_stress_MPa,dissipation_ratio,damage_share" }
FNR == 1 { read_header(); next }
{
  ++n
  part[n] = $need("part")
  row[n] = $need("time_us") "," $need("mean_stress_MPa") "," $need("deviatoric_stress_MPa")
  damage[n] = $need("damage_dissipation_mJ")
  dissipation[n] = $need("plastic_dissipation_mJ") + damage[n]
  if (part[n] == "test" && !reference) reference = dissipation[n]
}
END {
  if (failed) exit 1
  if (!reference) { print "dissipation: no probe in the path" > "/dev/stderr"; exit 1 }
  for (i = 1; i <= n; ++i) printf "%s,%s,%.8g,%.3g\n", part[i], row[i], dissipation[i] / reference, (dissipation[i] ? damage[i] / dissipation[i] : 0)
}
