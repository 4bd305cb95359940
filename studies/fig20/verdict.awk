# awk -f ../common/verdict.awk -f ../branches/triaxial.awk -f verdict.awk tests.csv
# Tests stand from the largest to the smallest fracture energy, those with the law `energy` and no bonds first.
BEGIN { FS = "," }
FNR == 1 { read_header(); next }
{ read_curves() }
# Where a largest value stands; within the last hundredth of the test it has not been passed.
function place(at, r) { return at < 0.99 * strain[r] ? at : strain[r] }
END {
  if (failed) exit 1
  rising = later = prolonged = looser = 1
  for (i = 1; i <= runs; ++i) {
    r = run[i]
    g = sprintf("%g", fracture_energy[r])
    if (softening[r] == "exponential" && fracture_energy[r] > 0) {
      other = list_add(other, sprintf("G^c = %s: peak %.1f MPa at %.1f %%, then %.1f MPa, volumetric strain %.2f %%", \
                                      g, q_max[r], 100 * q_max_at[r], q[r], 100 * volumetric[r]))
      if (fracture_energy[r] == 0.5) exponential = r
      continue
    }
    if (highest == "") highest = r
    peaks = list_add(peaks, sprintf("%.1f MPa (%s)", q_max[r], g))
    places = list_add(places, sprintf("%.1f %% (%s)", 100 * q_max_at[r], g))
    falls = list_add(falls, sprintf("%.0f %% (%s)", 100 * (1 - q[r] / q_max[r]), g))
    volumes = list_add(volumes, sprintf("%.2f %% (%s)", 100 * volumetric[r], g))
    turns = list_add(turns, sprintf("%.1f %% (%s)", 100 * contraction_max_at[r], g))
    if (last != "") {
      if (q_max[r] > 1.005 * q_max[last]) rising = 0
      if (place(q_max_at[r], r) > place(q_max_at[last], last) + 1e-4) later = 0
      if (volumetric[r] > volumetric[last] + 1e-3) looser = 0
      if (place(contraction_max_at[r], r) > place(contraction_max_at[last], last) + 1e-4) prolonged = 0
    }
    last = r
  }
  if (last == highest) { print "verdict: one test only" > "/dev/stderr"; exit 1 }
  statement("Law `energy`: the largest deviatoric stress rises with the fracture energy", "rises", peaks, rising && q_max[last] < q_max[highest], "values by G^c in N/mm; differences below 0.5 % count as none")
  statement("Law `energy`: the sample of the largest fracture energy hardens, those of low fracture energy pass a peak and soften", \
            "hardening at high, peak and softening at low G^c", "fall from the largest q to 15 %: " falls, \
            !softens(highest) && softens(last), "judged at the largest G^c and without bonds; a fall of 2 % is taken as softening")
  statement("Law `energy`: the lower the fracture energy, the earlier the largest deviatoric stress", "earlier", places, later, "axial strain there; within the last hundredth of the test: none has been passed")
  statement("Law `energy`: the lower the fracture energy, the more dilative the sample at 15 %", "more dilative", volumes, looser && volumetric[last] < volumetric[highest], "contraction positive; differences below 0.1 % count as none")
  statement("Law `energy`: high fracture energy prolongs the contraction", "prolonged", turns, prolonged && contraction_max_at[last] < contraction_max_at[highest], \
            "axial strain at the largest contraction; within the last hundredth of the test: it still contracts")
  if (exponential != "")
    statement("Law `exponential`: the sample of G^c = 0.5 N/mm hardens", "hardens", other, !softens(exponential), \
              "the law that Fig. 3 of the paper draws; see fig18")
  statements_of_quality()
  end_of_verdict()
}
