# awk -f eq13.awk -f surface.awk fits.json: both surfaces on a grid, with blank lines between values of G^c.
END {
  print "confining_stress_MPa,fracture_energy_N_per_mm,q_fit_MPa,q_paper_MPa"
  for (j = 0; j <= 24; ++j) {
    for (i = 0; i <= 24; ++i) printf "%.6g,%.6g,%s\n", 16 * i / 24, 0.5 * j / 24, surfaces(16 * i / 24, 0.5 * j / 24)
    print ""
  }
}
