# awk -f ../common/verdict.awk -f curves.awk release.csv COMPACTION/curve.csv UNLOADING/curve.csv ...: elastic energy over
# relative density through loading and unloading, for every row of release.csv in its order; over E R^3 too.
BEGIN { FS = ","; print "youngs_modulus [MPa],part,relative_density [1],elastic_energy [mJ],elastic_energy_over_scale [1]" }
FNR == 1 { ++file; split("", column); read_header(); next }
file == 1 {
  modulus[FNR - 1] = $need("youngs_modulus")
  scale[FNR - 1] = $need("scale")
  next
}
{
  row = int(file / 2)
  part = file % 2 ? "unloading" : "loading"
  printf "%s,%s,%s,%s,%.6g\n", modulus[row], part, $need("relative_density"), $need("elastic_energy"), $need("elastic_energy") / scale[row]
}
