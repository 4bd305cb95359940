# awk -f ../common/verdict.awk -f verdict.awk summary.csv still.csv
# What is expected of a case: 0: it ends, with the energy balance closed to 2 %; 3: it fails with a message; any: either of them.
BEGIN { FS = "," }
FNR == 1 { ++file; if (file == 1) read_header(); next }
file == 2 { still[$1] = $2; next }
{
  code = $need("exit_code")
  ends = code == 0 && $need("not_finite") == 0 && $need("residual_over_largest") < 0.02 && $need("penetration_over_h") < 0.5
  # Where either will do, a balance that is off must at least have been warned of.
  held = code == 0 && $column["not_finite"] == 0 && $column["residual_over_largest"] < 0.1 && ($column["residual_over_largest"] < 0.011 || $need("message") ~ /warning/)
  fails = code == 3 && $need("message") ~ /error/
  expected = $need("expected")
  seen = code == 0 ? sprintf("ends; residual %s, penetration %s h", $column["residual_over_largest"], $column["penetration_over_h"]) \
                   : "fails: " $column["message"]
  statement($1 ": " $2, expected == "0" ? "ends, energy balance closed to 2 %" : expected == "3" ? "fails, and says why" : "ends or fails; warns of a balance off by more than 1 %, fails beyond 10 %", \
            seen, expected == "0" ? ends : expected == "3" ? fails : held || fails, (code == 0 ? $column["message"] : ""))
}
END {
  if (failed) exit 1
  creep = absolute(still["plastic dissipation over elastic energy"]) + absolute(still["damage dissipation over elastic energy"])
  statement("still: a million steps change nothing in a compact at rest", "no drift, no creep, no heating", \
            sprintf("elastic energy %s, stress %s, dissipation %.1e, kinetic energy %s of the elastic at most, %s at the end", still["change of elastic energy"], \
                    still["change of mean stress"], creep, still["largest kinetic over elastic energy after that"], still["kinetic over elastic energy at the end"]), \
            still["steps"] >= 1e6 && absolute(still["change of elastic energy"]) < 1e-6 && absolute(still["change of mean stress"]) < 1e-3 && creep < 1e-6 && \
            still["largest kinetic over elastic energy after that"] < 1e-9 && absolute(still["residual over elastic energy"]) < 1e-6, \
            "in parts of what it was at the beginning, or of the elastic energy")
  end_of_verdict()
}
