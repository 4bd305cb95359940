# awk -F, -v mesh=NAME -v reference=NAME -f forecast.awk PLAN REFERENCE-PLAN REFERENCE-TIMES: how long each study would take.
#
# A study's tet-steps are those that it took with the reference mesh, times the ratio of tets times steps that `mpfem check` finds
# for the same compaction with both meshes: elements of half the size are eight times as many and take steps half as long, or
# shorter where slivers are. What a tet-step costs is measured on this machine in the loose packing; contact and the shrinking of
# steps make it half as much again over a run. Contact and bonds of a dense packing make 300 B a tet of the 143 B that the plan has
# (docs/performance.md).
BEGIN { contact = 1.5 }
function duration(s) {
  if (s >= 36000) return sprintf("%.0f h", s / 3600)
  if (s >= 3600) return sprintf("%.1f h", s / 3600)
  return s >= 60 ? sprintf("%.0f min", s / 60) : sprintf("%.0f s", s)
}
FNR == 1 { ++file; for (i = 1; i <= NF; ++i) column[file, $i] = i; next }
file == 1 { size = $column[1, "tets"] * $column[1, "steps"]; memory = $column[1, "memory_MB"]; threads = $column[1, "threads"]
  cost = contact * $column[1, "ns_per_tet_step"]; tets = $column[1, "tets"]; next }
file == 2 { ratio = size / ($column[2, "tets"] * $column[2, "steps"]); next }
{
  if (!(ratio > 0)) { print "forecast.awk: no plan of the reference mesh" > "/dev/stderr"; failed = 1; exit }
  steps = ratio * $column[3, "tet_steps"]
  if (!headed++) {
    printf "MESH=%s: %d tets, some %.2g GB a run; %.0f ns a tet-step on %d threads here\n\n", mesh, tets, 2.1e-3 * memory, cost, threads
    printf "%-8s %6s %12s %10s\n", "study", "runs", "tet-steps", "here"
  }
  printf "%-8s %6d %12.3g %10s\n", $column[3, "study"], $column[3, "runs"], steps, (steps > 0 ? duration(steps * cost * 1e-9) : "-")
  all += steps
}
END {
  if (failed || !headed) exit 1
  printf "%-8s %6s %12.3g %10s\n\n", "all", "", all, duration(all * cost * 1e-9)
  printf "Scaled from what the studies took with MESH=%s; a run that several use counts for the first of them.\n", reference
}
