# awk -f ../common/verdict.awk -f loops.awk out/MESH/branches/NAME-cycles/curve.csv...: p over D_r. Cycle 0 is the first loading with
# the unloading after it; others begin where p rises from the lowest stress.
BEGIN { FS = ","; print "sample,cycle,relative_density,mean_stress_MPa" }
FNR == 1 {
  read_header()
  folders = split(FILENAME, folder, "/")
  name = folder[folders - 1]
  sub(/-cycles$/, "", name)
  cycle = 0
  loaded = 1
  was = 1e9
  next
}
/^#/ { next }
$need("stage") >= 1 {
  p = $need("mean_stress")
  if (!loaded && p > was) { ++cycle; loaded = 1 }
  if (p <= 1 && was > p) loaded = 0
  was = p
  printf "%s,%d,%.8g,%.6g\n", name, cycle, $need("relative_density"), p
}
END { exit failed }
