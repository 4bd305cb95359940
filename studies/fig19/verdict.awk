# awk -f ../common/verdict.awk -f ../branches/triaxial.awk -f verdict.awk tests.csv
BEGIN { FS = "," }
FNR == 1 { read_header(); next }
{ read_curves() }
END {
  if (failed) exit 1
  more_damage = more_plastic = 1
  for (i = 1; i <= runs; ++i) {
    r = run[i]
    if (softening[r] != "energy") continue
    damages = list_add(damages, sprintf("%.3g mJ at %.2f", damage[r], density[r]))
    plastics = list_add(plastics, sprintf("%.3g mJ at %.2f", plastic[r], density[r]))
    if (last && damage[r] >= damage[last]) more_damage = 0
    if (last && plastic[r] >= plastic[last]) more_plastic = 0
    last = r
  }
  if (last == "") { print "verdict: no test with the law 'energy'" > "/dev/stderr"; exit 1 }
  statement("Energy dissipated by damage up to 15 % of axial strain grows with the density reached in compaction", "grows", damages, more_damage, "")
  statement("Energy dissipated by plastic flow up to 15 % of axial strain grows with the density reached in compaction", "grows", plastics, more_plastic, "")
  end_of_verdict()
}
