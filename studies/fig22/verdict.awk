# awk -f ../common/verdict.awk -f verdict.awk energy-fits.json energy-points.csv exponential-fits.json exponential-points.csv
BEGIN { FS = "," }
FNR == 1 { ++file; law = file <= 2 ? "energy" : "exponential" }
file % 2 {
  if (match($0, /"[ABCD]": \{/)) name = substr($0, RSTART + 1, 1)
  text = $0
  sub(/^[^:]*: */, "", text)
  if (/"r_squared_of_y":/) r_squared[law] = text + 0
  if (name != "" && /"value":/) value[law, name] = text + 0
  if (name != "" && /"low":/) low[law, name] = text + 0
  if (name != "" && /"high":/) { high[law, name] = text + 0; name = "" }
  next
}
FNR == 1 { split("", column); read_header(); next }
{
  n = ++points[law]
  p[law, n] = $need("p_c") + 0
  g[law, n] = $need("G_c") + 0
  q[law, n] = $need("q") + 0
}
function coefficient(law, name, words, paper, unit) {
  statement("Law `" law "`, Eq. 13: " words, sprintf("%s %s", paper, unit), \
            sprintf("%.3g %s, 95 %% interval %.3g ... %.3g", value[law, name], unit, low[law, name], high[law, name]), \
            high[law, name] - low[law, name] > absolute(value[law, name]) ? -1 : absolute(value[law, name] / paper - 1) <= 0.15, \
            "taken as agreement: 15 %; not judged where the interval is wider than the value")
}
# Strength at 8 MPa, beside what Eq. 13 gives there.
function at_8_MPa(law, energy,   i, paper) {
  for (i = 1; i <= points[law]; ++i)
    if (p[law, i] == 8 && g[law, i] == energy) {
      paper = 89.93 - 73.64 * exp(-8 / 7.51) * exp(-energy / 0.11)
      statement((energy ? "Law `" law "`: s" : "S") "trength at 8 MPa " (energy ? "with G^c = " energy " N/mm" : "without bonds"), \
                sprintf("%.1f MPa by Eq. 13", paper), sprintf("%.1f MPa", q[law, i]), absolute(q[law, i] / paper - 1) <= 0.15, "taken as agreement: 15 %")
    }
}
function judge(law,   i, j, pairs_p, pairs_g, falls_p, falls_g) {
  coefficient(law, "A", "largest strength A", 89.93, "MPa")
  coefficient(law, "B", "B, by which it is less without confinement and bonds", 73.64, "MPa")
  coefficient(law, "C", "C, the confining stress of the exponential", 7.51, "MPa")
  coefficient(law, "D", "D, the fracture energy of the exponential", 0.11, "N/mm")
  statement("Law `" law "`: Eq. 13 describes the tests", "R^2 = 0.978", sprintf("R^2 = %.3f, %d tests", r_squared[law], points[law]), \
            r_squared[law] >= 0.95, "taken as agreement: at least 0.95")
  for (i = 1; i <= points[law]; ++i)
    for (j = 1; j <= points[law]; ++j) {
      if (p[law, i] == p[law, j] && g[law, i] < g[law, j]) { ++pairs_g; if (q[law, i] > 1.01 * q[law, j]) ++falls_g }
      if (g[law, i] == g[law, j] && p[law, i] < p[law, j]) { ++pairs_p; if (q[law, i] > 1.01 * q[law, j]) ++falls_p }
    }
  statement("Law `" law "`: strength rises with the confining stress", "rises", sprintf("in %d of %d pairs of the same G^c", pairs_p - falls_p, pairs_p), \
            !falls_p, "differences below 1 % count as none")
  statement("Law `" law "`: strength rises with the fracture energy", "rises", sprintf("in %d of %d pairs of the same p_c", pairs_g - falls_g, pairs_g), \
            !falls_g, "differences below 1 % count as none")
}
END {
  if (failed) exit 1
  if (!(("energy", "A") in value) || !(("exponential", "A") in value)) { print "verdict: no fit" > "/dev/stderr"; exit 1 }
  at_8_MPa("energy", 0)
  at_8_MPa("energy", 0.1)
  at_8_MPa("energy", 0.5)
  judge("energy")
  at_8_MPa("exponential", 0.1)
  at_8_MPa("exponential", 0.5)
  judge("exponential")
  end_of_verdict()
}
