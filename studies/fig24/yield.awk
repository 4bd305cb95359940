# awk -f yield.awk out/MESH/branches/NAME-probeANGLE/yield.json...: yield points, empty where a probe did not yield.
BEGIN { print "softening,fracture_energy_N_per_mm,angle_degrees,yielded,mean_stress_MPa,deviatoric_stress_MPa,mean_stress_uncertainty_MPa,deviatoric_stress_uncertainty_MPa" }
FNR == 1 {
  put()
  folders = split(FILENAME, folder, "/")
  name = folder[folders - 1]
  softening = name ~ /^energy-/ ? "energy" : "exponential"
  energy = name
  sub(/^(energy-)?g/, "", energy)
  sub(/-.*$/, "", energy)
  angle = name
  sub(/^.*-probe/, "", angle)
  p = q = p_error = q_error = ""
}
/"mean_stress_MPa": *[-0-9]/ { p = number() }
/"deviatoric_stress_MPa": *[-0-9]/ { q = number() }
/"mean_stress_uncertainty_MPa":/ { p_error = number() }
/"deviatoric_stress_uncertainty_MPa":/ { q_error = number() }
END { put() }
function number(   text) {
  text = $0
  sub(/^[^:]*: */, "", text)
  sub(/,? *$/, "", text)
  return text
}
function put() { if (name != "") printf "%s,%s,%s,%d,%s,%s,%s,%s\n", softening, energy, angle, (q != ""), p, q, p_error, q_error }
