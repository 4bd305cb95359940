# awk -f loading.awk COMPACTION/curve.csv UNLOADING/curve.csv UNCONFINED/curve.csv: axial stress over axial strain through the three
# stages; the unconfined stage refers both to the sample at its beginning, the others to the box.
BEGIN { FS = ","; print "stage,axial_strain [1],axial_stress [MPa]" }
FNR == 1 {
  ++file
  split("", at)
  for (i = 1; i <= NF; ++i) {
    name = $i
    sub(/ *\[.*$/, "", name)
    at[name] = i
  }
  next
}
# The compaction goes on beyond this branch's density only if it began below the last one.
$at["stage"] == (file == 1 ? 0 : 1) {
  printf "%s,%s,%.6g\n", (file == 1 ? "loading" : file == 2 ? "unloading" : "reloading"), $at["axial_strain"], \
         ($at["wall_stress_4"] + $at["wall_stress_5"]) / 2
}
