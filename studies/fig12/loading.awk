# awk -f ../common/verdict.awk -f loading.awk COMPACTION/curve.csv UNLOADING/curve.csv UNCONFINED/curve.csv: axial stress over
# axial strain through the three stages; the unconfined stage refers both to the sample at its beginning, the others to the box.
BEGIN { FS = ","; print "stage,axial_strain [1],axial_stress [MPa]" }
FNR == 1 { ++file; split("", column); read_header(); next }
# The compaction goes on beyond this branch's density only if it began below the last one.
$need("stage") == (file == 1 ? 0 : 1) {
  printf "%s,%s,%.6g\n", (file == 1 ? "loading" : file == 2 ? "unloading" : "reloading"), $need("axial_strain"), \
         ($need("wall_stress_4") + $need("wall_stress_5")) / 2
}
