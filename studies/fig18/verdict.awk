# awk -f ../common/verdict.awk -f ../branches/triaxial.awk -f verdict.awk tests.csv
BEGIN { FS = "," }
FNR == 1 { read_header(); next }
{ read_curves() }

# Judges the tests of one softening law, which stand from the largest to the smallest density.
function judge(law, words,   i, r, last, hardens, higher, contracts, more, stresses, strains, tests) {
  hardens = higher = contracts = more = 1
  for (i = 1; i <= runs; ++i) {
    r = run[i]
    if (softening[r] != law) continue
    ++tests
    stresses = list_add(stresses, sprintf("%.1f MPa at %.2f%s", q[r], density[r], \
                                          softens(r) ? sprintf(" after a peak of %.1f at %.1f %%", q_max[r], 100 * q_max_at[r]) : ""))
    strains = list_add(strains, sprintf("%.2f %% at %.2f", 100 * volumetric[r], density[r]))
    if (softens(r)) hardens = 0
    if (volumetric[r] <= 0) contracts = 0
    if (last && q[r] >= q[last]) higher = 0
    if (last && volumetric[r] <= volumetric[last]) more = 0
    last = r
  }
  if (!tests) return
  statement(words "every sample hardens up to 15 % of axial strain", "all harden", stresses, hardens, \
            "a fall of 2 % from the largest q is taken as softening")
  if (tests > 1) statement(words "the larger the density reached in compaction, the larger q at 15 %", "larger", stresses, higher, "")
  statement(words "every sample contracts (volumetric strain at 15 %)", "contraction in all cases", strains, contracts, "")
  if (tests > 1) statement(words "the smaller the density reached in compaction, the more it contracts", "more", strains, more, "")
}

END {
  if (failed) exit 1
  judge("energy", "Law `energy`: ")
  judge("exponential", "Law `exponential`: ")
  statements_of_quality()
  end_of_verdict()
}
