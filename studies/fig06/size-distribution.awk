# Spheres x,y,z,radius in mm, ascending in radius -> their number-cumulative curve, at each sphere's middle (i - 1/2)/n.
BEGIN { FS = "," }
$4 + 0 > 0 { diameter[++n] = 2 * $4 }
END {
  if (!n) {
    print "no spheres" > "/dev/stderr"
    exit 1
  }
  print "diameter_mm,cumulative_number"
  for (i = 1; i <= n; ++i) printf "%.9g,%.9g\n", diameter[i], (i - 0.5) / n
}
