# awk -f ../common/verdict.awk -f verdict.awk -v mesh=MESH -v density=D stress.csv; density: the last snapshot's
BEGIN { FS = ","; fineness = split("coarse,intermediate,medium,paper", order, ",") }
FNR == 1 { read_header(); next }
$need("relative_density") + 0 == density + 0 {
  name = $need("mesh")
  peak[name] = $need("percentile_99_MPa")
  middle[name] = $need("median_MPa")
  share[name] = $need("share_above_yield")
}
END {
  if (failed) exit 1
  if (!(mesh in peak)) {
    print "verdict: no section of mesh '" mesh "' at " density > "/dev/stderr"
    exit 1
  }
  text = "Finer meshes resolve higher stress at the contacts: 99th percentile of the von Mises stress at D_r = " density
  rising = 1
  for (i = 1; i <= fineness; ++i)
    if (order[i] in peak) {
      list = list (present ? ", " : "") sprintf("%s %.1f MPa", order[i], peak[order[i]])
      if (present && peak[order[i]] < before) rising = 0
      before = peak[order[i]]
      ++present
    }
  if (present >= 2)
    statement(text, "concentration better captured by finer meshes", list, rising, "weighted by area on the central section")
  else
    statement(text, "concentration better captured by finer meshes", sprintf("%.1f MPa", peak[mesh]), -1, \
              "needs at least two of MESH=coarse, intermediate, medium, paper")
  statement("Median von Mises stress, and share of the section above the initial yield stress, at D_r = " density, "drawn only", \
            sprintf("%.1f MPa, %.1f %%", middle[mesh], 100 * share[mesh]), -1, "no value is stated to compare with")
  end_of_verdict()
}
