# awk -f ../common/verdict.awk -f verdict.awk yield.csv
BEGIN { FS = "," }
FNR == 1 { read_header(); next }
{
  series = $need("softening") " " ($need("fracture_energy_N_per_mm") + 0)
  angle = $need("angle_degrees") + 0
  if (!(angle in known)) { known[angle] = 1; angles[++n] = angle }
  p = $need("mean_stress_MPa")
  q = $need("deviatoric_stress_MPa")
  if (p != "" && q != "") {
    distance[series, angle] = sqrt((p - 60) ^ 2 + q ^ 2)
    mean[series, angle] = p
    deviator[series, angle] = q
  }
}
# Compares a cohesive series with the other in the directions from `from` to `to` degrees either side of the p axis.
function compare(series, from, to, wanted, words, paper,   i, a, ratio, list, judged, agreeing) {
  for (i = 1; i <= n; ++i) {
    a = angles[i]
    if (absolute(a) < from || absolute(a) > to || !(("exponential 0", a) in distance)) continue
    ++judged
    if (!((series, a) in distance)) {
      # It would have yielded further out than the path reaches, where a wall bears nothing.
      list = list_add(list, sprintf("none before a wall is bare at %d degrees", a))
      if (wanted > 0) ++agreeing
      continue
    }
    ratio = distance[series, a] / distance["exponential 0", a]
    list = list_add(list, sprintf("%.2f at %d degrees", ratio, a))
    if (wanted * (ratio - 1) > 0) ++agreeing
  }
  if (judged) statement(words, paper, "distance from 60 MPa over that without bonds: " list, agreeing == judged, \
                        "directions in the plane of p and q, 0 degrees along p; all of them must agree")
}
function surface(series,   i, text) {
  for (i = 1; i <= n; ++i)
    if ((series, angles[i]) in distance) text = list_add(text, sprintf("(%.0f, %.0f)", mean[series, angles[i]], deviator[series, angles[i]]))
  return text
}
END {
  if (failed) exit 1
  compare("energy 0.5", 0, 45, 1, "Law `energy`: at high mean stress the cohesive yield surface is the larger one", "larger")
  compare("energy 0.5", 100, 180, -1, "Law `energy`: at low mean stress the cohesive yield surface is the smaller one", "smaller (inferred, the surface being half known)")
  compare("exponential 0.5", 0, 45, 1, "Law `exponential`: at high mean stress the cohesive yield surface is the larger one", "larger")
  compare("exponential 0.5", 100, 180, -1, "Law `exponential`: at low mean stress the cohesive yield surface is the smaller one", "smaller (inferred, the surface being half known)")
  end_of_verdict()
}
