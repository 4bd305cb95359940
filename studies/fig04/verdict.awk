# awk -f ../common/verdict.awk -f verdict.awk -v mesh=MESH cohesive.csv summary.csv

BEGIN { FS = "," }
FNR == 1 { ++file; split("", column); read_header(); next }
file == 1 { exact[$1, $2] = $4; next }
{
  name = $1
  loading[name] = $need("loading_mean_error")
  unloading[name] = $need("unloading_error")
  pull[name] = $need("pull_off_over_jkr")
  cap[name] = $need("strength_cap_over_jkr")
  ++rows
}

function percent(x) { return sprintf("%.2g %%", 100 * x) }

END {
  if (failed || !rows) exit 1
  energies = split("w0.01 w0.1 w0.5", energy, " ")
  for (i = 1; i <= energies; ++i) {
    worst_loading = loading[energy[i]] > worst_loading ? loading[energy[i]] : worst_loading
    worst_unloading = unloading[energy[i]] > worst_unloading ? unloading[energy[i]] : worst_unloading
    d = absolute(pull[energy[i]] / exact[substr(energy[i], 2), 2] - 1)
    worst_pull = d > worst_pull ? d : worst_pull
    list = list sprintf("%s%.3f", i > 1 ? ", " : "", pull[energy[i]])
  }
  statement("Loading follows Hertz whatever the fracture energy", "matches Hertz for all three", \
            percent(worst_loading) " largest mean error of the three", worst_loading <= 0.02, \
            "hemispheres driven at their equator: Hertz with their missing compliance; agreement: 2 %, own aim")
  statement("Unloading follows JKR down to the pull-off", "matches JKR", \
            percent(worst_unloading) " of the range of forces, root mean square, largest of the three", worst_unloading <= 0.02, \
            "at lambda = 2; agreement: 2 %, own aim")
  statement("The pull-off force is that of JKR", "1.5 pi w R/2", list " of it for 0.01, 0.1 and 0.5 N/mm", worst_pull <= 0.03, \
            "boundary elements with the same bonds give 1.005; agreement with them: 3 %, own aim")
  if ("lambda-0.114" in pull) {
    low = pull["lambda-0.114"]
    statement("With the 25 MPa of Table 1 the pull-off force is that of JKR", "agreement with JKR is shown", \
              sprintf("%.2f of it at G^c = 0.1 N/mm; the bonded area bears at most %.2f", low, cap["lambda-0.114"]), low > 0.97 && low < 1.03, \
              "bonds act where contact was made only, so that strength times area limits the force: JKR needs some 440 MPa here")
    names = split("0.114 0.25 0.5 1", lambda, " ")
    for (i = 1; i <= names; ++i) {
      d = absolute(pull["lambda-" lambda[i]] / exact["0.1", lambda[i]] - 1)
      worst_strength = d > worst_strength ? d : worst_strength
      strengths = strengths sprintf("%s%.3f (%.3f)", i > 1 ? ", " : "", pull["lambda-" lambda[i]], exact["0.1", lambda[i]])
    }
    statement("Between the two limits pull-off follows the strength as a boundary-element solution of the same bonds does", "not stated", \
              strengths " of JKR at lambda = 0.114, 0.25, 0.5, 1 (in brackets: boundary elements)", worst_strength <= 0.03, "agreement: 3 %, own aim")
    statement("Penalty and speed do not matter", "not stated", \
              sprintf("pull-off %.3f, %.3f, %.3f with K = 3, 10, 30 E/h; %.3f, %.3f, %.3f, %.3f at 1/2, 1, 2 and 4 times the speed", \
                      pull["penalty-3"], pull["mesh-8"], pull["penalty-30"], pull["speed-0.5"], pull["mesh-8"], pull["speed-2"], pull["speed-4"]), \
              absolute(pull["penalty-30"] / pull["mesh-8"] - 1) < 0.02 && absolute(pull["speed-0.5"] / pull["mesh-8"] - 1) < 0.01, \
              "agreement: 2 % for three times the penalty, 1 % for half the speed")
    statement("The curves converge with the mesh", "not stated", \
              sprintf("loading %s, %s, %s, %s, %s; pull-off %.3f, %.3f, %.3f, %.3f, %.3f at 4, 6, 8, 13, 17 elements a pull-off radius; with plain tets loading %s at 8", \
                      percent(loading["mesh-4"]), percent(loading["mesh-6"]), percent(loading["mesh-8"]), percent(loading["mesh-13"]), percent(loading["w0.1"]), \
                      pull["mesh-4"], pull["mesh-6"], pull["mesh-8"], pull["mesh-13"], pull["w0.1"], percent(loading["tet4-8"])), \
              loading["w0.1"] <= loading["mesh-6"], "own statement")
  } else
    statement("With the 25 MPa of Table 1 the pull-off force is that of JKR", "agreement with JKR is shown", "not run", -1, \
              "MESH=smoke runs the three energies only, on a coarse mesh")
  end_of_verdict()
}
