# awk -f ../common/verdict.awk -f verdict.awk -v mesh=MESH summary.csv
BEGIN { FS = "," }
FNR == 1 { read_header(); next }
{
  name = $1
  error[name] = $need("largest_error")
  mean[name] = $need("mean_error")
  law[name] = $need("largest_error_similarity")
  pull[name] = $need("pull_off_over_similarity")
  away[name] = $need("unloading_error_similarity")
  ++rows
}
function percent(x) { return sprintf("%.2g %%", 100 * x) }
END {
  if (failed || !rows) exit 1
  for (name in error) {
    if (name ~ /^table-1/) { if (error[name] > table) table = error[name]; if (law[name] > similarity) similarity = law[name]; pulls = pulls sprintf("%s%.2f", pulls == "" ? "" : ", ", pull[name]); if (away[name] > unloading) unloading = away[name] }
    if (name ~ /^total-strain/ && error[name] > total) total = error[name]
  }
  statement("Loading with the hardening of Table 1 is that of converged finite elements", "not stated", \
            percent(table) " largest difference from a quarter of the largest approach on", table <= 0.03, "axisymmetric rows; agreement: 3 %, own aim")
  statement("Loading with sigma = 160 eps^0.4 is that of converged finite elements", "not stated", \
            total ? percent(total) " largest difference from a quarter of the largest approach on" : "not run", total ? total <= 0.03 : -1, "axisymmetric rows; agreement: 3 %, own aim")
  statement("Loading follows the similarity law", "agrees with the law", percent(similarity) " largest difference from h/R = 0.02 on, hardening of Table 1", \
            similarity <= 0.15, "the law itself is 4 to 14 % off converged finite elements; agreement: 15 %")
  statement("Bonded unloading pulls off as the similarity law with toughness does", "agrees with the law", pulls " of the law's pull-off force", \
            pull["table-1-0.04"] > 0.85 && pull["table-1-0.04"] < 1.15, "G^c = 0.01 N/mm, 25 MPa; agreement: 15 % at h/R = 0.04")
  statement("Bonded unloading follows the similarity law down to the pull-off", "agrees with the law", \
            percent(unloading) " of the range of forces, root mean square, largest of the approaches", unloading <= 0.1, \
            "the law knows toughness alone, no strength; agreement: 10 %")
  if ("mesh-7" in error)
    statement("The loading curve converges with the mesh", "not stated", \
              sprintf("mean difference %s, %s, %s, %s with 7, 10, 15, 21 elements in the contact radius; with plain tets %s, %s at 7, 10", \
                      percent(mean["mesh-7"]), percent(mean["mesh-10"]), percent(mean["mesh-15"]), percent(mean["table-1-0.08"]), percent(mean["tet4-7"]), percent(mean["tet4-10"])), \
              absolute(mean["table-1-0.08"]) <= absolute(mean["mesh-7"]), "own statement")
  end_of_verdict()
}
