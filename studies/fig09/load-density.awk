# Curves out/MESH/compaction/curve.csv -> one table: mesh, relative density, mean stress in MPa.
BEGIN { FS = ","; print "mesh,relative_density,mean_stress_MPa" }
FNR == 1 {
  mesh = FILENAME
  sub(/^out\//, "", mesh)
  sub(/\/.*$/, "", mesh)
  density = stress = 0
  for (i = 1; i <= NF; ++i) {
    name = $i
    gsub(/"|[ \t\r]|[[(].*$/, "", name)
    if (name == "relative_density") density = i
    if (name == "mean_stress") stress = i
  }
  if (!density || !stress) {
    print FILENAME ": no column 'relative_density' or 'mean_stress'" > "/dev/stderr"
    exit 1
  }
  next
}
/^#/ { next }
{ printf "%s,%s,%s\n", mesh, $density, $stress }
