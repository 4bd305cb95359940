# awk -f ../common/verdict.awk -f verdict.awk summary.csv still.csv
# What is expected of a case: 0: it ends, with the energy balance closed to 2 %; 3: it fails with a message; any: either
# of them.
BEGIN { FS = "," }
FNR == 1 { ++file; if (file == 1) read_header(); next }
file == 2 { still[$1] = $2; next }
{
  code = $need("exit_code")
  ends = code == 0 && $need("not_finite") == 0 && $need("residual_over_largest") < 0.02 && \
         $need("penetration_over_h") < 0.5
  # Where either will do, a balance that is off must at least have been warned of.
  held = code == 0 && $column["not_finite"] == 0 && $column["residual_over_largest"] < 0.1 && \
         ($column["residual_over_largest"] < 0.011 || $need("message") ~ /warning/)
  fails = code == 3 && $need("message") ~ /error/
  expected = $need("expected")
  residual = $column["residual_over_largest"]
  seen = code == 0 ? sprintf("ends; residual %s, penetration %s h", residual, $column["penetration_over_h"]) \
                   : "fails: " $column["message"]
  wanted = "ends or fails; warns of a balance off by more than 1 %, fails beyond 10 %"
  if (expected == "0") wanted = "ends, energy balance closed to 2 %"
  if (expected == "3") wanted = "fails, and says why"
  statement($1 ": " $2, wanted, seen, expected == "0" ? ends : expected == "3" ? fails : held || fails, \
            (code == 0 ? $column["message"] : ""))
}
END {
  if (failed) exit 1
  elastic = still["change of elastic energy"]
  stress = still["change of mean stress"]
  creep = absolute(still["plastic dissipation over elastic energy"]) + \
          absolute(still["damage dissipation over elastic energy"])
  kinetic = still["largest kinetic over elastic energy after that"]
  seen = sprintf("elastic energy %s, stress %s, dissipation %.1e, ", elastic, stress, creep) \
         sprintf("kinetic energy %s of the elastic at most, %s at the end", kinetic, \
                 still["kinetic over elastic energy at the end"])
  rests = still["steps"] >= 1e6 && absolute(elastic) < 1e-6 && absolute(stress) < 1e-3 && creep < 1e-6 && \
          kinetic < 1e-9 && absolute(still["residual over elastic energy"]) < 1e-6
  statement("still: a million steps change nothing in a compact at rest", "no drift, no creep, no heating", \
            seen, rests, "in parts of what it was at the beginning, or of the elastic energy")
  end_of_verdict()
}
