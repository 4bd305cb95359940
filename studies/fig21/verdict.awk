# awk -f ../common/verdict.awk -f verdict.awk sections.csv ../fig20/tests.csv
BEGIN { FS = "," }
FNR == 1 { ++file; split("", column); read_header(); next }
file == 1 {
  mean[$need("fracture_energy_N_per_mm") + 0] = $need("mean_damage")
  broken[$column["fracture_energy_N_per_mm"] + 0] = $need("broken_share")
}
file == 2 && $need("softening") == "energy" { all[$need("fracture_energy_N_per_mm") + 0] = $need("mean_damage") }
END {
  if (failed) exit 1
  if (!(0.5 in mean) || !(0.1 in mean)) { print "verdict: sections of 0.5 and 0.1 N/mm are needed" > "/dev/stderr"; exit 1 }
  statement("Bonds on the middle section are much more damaged with G^c = 0.1 N/mm than with 0.5 at 15 % of axial strain", "much more (drawn)", \
            sprintf("mean damage %.2f against %.2f, broken share of the bonded length %.0f %% against %.0f %%", \
                    mean[0.1], mean[0.5], 100 * broken[0.1], 100 * broken[0.5]), mean[0.1] >= 2 * mean[0.5], "taken as agreement: twice")
  statement("The same of all bonds of the sample", "not stated", sprintf("mean damage %.2f against %.2f", all[0.1], all[0.5]), \
            all[0.1] >= 2 * all[0.5], "taken as agreement: twice")
  end_of_verdict()
}
