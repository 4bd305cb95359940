# awk -F, -v mesh=NAME -v reference=NAME -f forecast.awk PLAN REFERENCE-PLAN REFERENCE-TIMES: how long each study would
# take.
#
# A study's tet-steps are those that it took with the reference mesh, times the ratio of tets times steps that
# `mpfem check` finds for the same compaction with both meshes: elements of half the size are eight times as many and
# take steps half as long, or shorter where slivers are; but fig04 and fig05 have meshes of their own. What a tet-step
# costs is measured on this machine in the loose packing. Dense packings with bonds take half as much again: triaxial
# tests of 329 grains took 54 ns in quiet moments where the plan had 35.5. They take 300 bytes per tetrahedron, where
# the plan has 143 (docs/performance.md).
BEGIN { contact = 1.5; memory_of_contact = 2.1 }
function duration(s) {
  if (s >= 36000) return sprintf("%.0f h", s / 3600)
  if (s >= 3600) return sprintf("%.1f h", s / 3600)
  return s >= 60 ? sprintf("%.0f min", s / 60) : sprintf("%.0f s", s)
}
function value(name) {
  if (!((file, name) in column)) {
    print "forecast.awk: " FILENAME " has no column " name > "/dev/stderr"
    failed = 1
    exit
  }
  return $column[file, name]
}
FNR == 1 { ++file; for (i = 1; i <= NF; ++i) column[file, $i] = i; next }
file == 1 {
  tets = value("tets")
  size = tets * value("steps")
  memory = value("memory_MB")
  threads = value("threads")
  cost = contact * value("ns_per_tet_step")
  next
}
file == 2 { ratio = size / (value("tets") * value("steps")); next }
{
  study = value("study")
  own_mesh = study == "fig04" || study == "fig05"
  steps = (own_mesh ? 1 : ratio) * value("tet_steps")
  if (!headed++) {
    printf "MESH=%s: %d tets, some %.2g GB a run; %.0f ns per tet-step on %d %s here\n\n", mesh, tets, \
           memory_of_contact * memory / 1000, cost, threads, (threads == 1 ? "core" : "threads")
    printf "%-8s %6s %12s %10s\n", "study", "runs", "tet-steps", "here"
  }
  printf "%-8s %6d %12.3g %10s\n", study, value("runs"), steps, (steps > 0 ? duration(steps * cost * 1e-9) : "-")
  if (value("missing") > 0) incomplete = incomplete " " study
  known[study] = 1
  all += steps
}
END {
  if (failed) exit 1
  if (!headed || !(ratio > 0)) {
    print "forecast.awk: the kept results of MESH=" reference " have no plan or no times" > "/dev/stderr"
    exit 1
  }
  printf "%-8s %6s %12.3g %10s\n\n", "all", "", all, duration(all * cost * 1e-9)
  printf "Scaled from what the studies took with MESH=%s; a run that several use counts for the first of them.\n", \
         reference
  if (threads == 1) print "make -jN THREADS=1 on N cores takes an N-th, since N runs go at once."
  for (i = 4; i <= 26; ++i) {
    study = sprintf("fig%02d", i)
    if (i != 6 && i != 7 && !(study in known)) unknown = unknown " " study
  }
  if (unknown) print "Not known:" unknown "."
  if (incomplete) print "Known in part:" incomplete "."
}
