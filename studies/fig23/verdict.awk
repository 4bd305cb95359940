# awk -f ../common/verdict.awk -f verdict.awk dissipation.csv yield.csv
BEGIN { FS = "," }
FNR == 1 { ++file; split("", column); read_header(); next }
file == 1 {
  ratio = $need("dissipation_ratio")
  if ($need("part") == "loading") loaded = ratio
  if ($column["part"] == "test") {
    share = $need("damage_share")
    if (ratio < 1 + 1e-4) { elastic_q = $need("deviatoric_stress_MPa") }
  }
}
file == 2 { yielded = 1; p = $need("mean_stress_MPa"); q = $need("deviatoric_stress_MPa") }
END {
  if (failed) exit 1
  statement("The isotropic unloading from the largest density to 60 MPa dissipates nothing", "none (assumed)", \
            sprintf("%.3f %% of the dissipation before it", 100 * (1 - loaded)), 1 - loaded <= 0.003, \
            "taken as nothing: less than the 0.3 % that counts as yield")
  statement("The probe yields where the total dissipation has risen to 1.003 times its value after unloading", "definition", \
            yielded ? sprintf("p = %.1f MPa, q = %.1f MPa; a rise of 0.01 %% is passed at q = %.1f MPa", p, q, elastic_q) : "not reached", yielded, "")
  statement("Damage is a marginal part of the dissipation, which is plastic", "marginal", sprintf("%.2g %% at the end of the probe", 100 * share), \
            share <= 0.05, "taken as marginal: 5 %")
  end_of_verdict()
}
