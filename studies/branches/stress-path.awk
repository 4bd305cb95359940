# awk -f ../common/verdict.awk -f stress-path.awk COMPACTION.csv UNLOADING.csv... TEST.csv: curves that follow one another as one
# path: the first is the loading, the last the test, those between the unloading.
BEGIN { FS = ","; print "part,time_us,relative_density,mean_stress_MPa,deviatoric_stress_MPa,plastic_dissipation_mJ,damage_dissipation_mJ" }
FNR == 1 { ++file; read_header(); next }
/^#/ { next }
{
  part = file == 1 ? "loading" : file == ARGC - 1 ? "test" : "unloading"
  printf "%s,%.6g,%.6g,%.6g,%.6g,%.9g,%.9g\n", part, 1e6 * $need("time"), $need("relative_density"), $need("mean_stress"), \
         $need("deviatoric_stress"), $need("plastic_dissipation"), $need("damage_dissipation")
}
END { exit failed }
