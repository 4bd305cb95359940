# awk -f eq13.awk -f cuts.awk fits.json points.csv: both surfaces along p_c (p) at each G^c of the points, and along G^c (g) at 8 MPa.
file == 2 && FNR > 1 {
  split($0, field, ",")
  if (!(field[2] in seen)) {
    seen[field[2]] = 1
    energy[++energies] = field[2]
  }
}
END {
  print "along,fixed,x,q_fit_MPa,q_paper_MPa"
  for (e = 1; e <= energies; ++e)
    for (i = 0; i <= 96; ++i) printf "p,%s,%.6g,%s\n", energy[e], i / 6, surfaces(i / 6, energy[e])
  for (i = 0; i <= 100; ++i) printf "g,8,%.6g,%s\n", i / 200, surfaces(8, i / 200)
}
