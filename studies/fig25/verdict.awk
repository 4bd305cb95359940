# awk -f ../common/verdict.awk -f verdict.awk cycles.csv
BEGIN { FS = "," }
FNR == 1 { read_header(); next }
{
  s = $need("sample")
  n = $need("cycle")
  cycles[s] = n
  area[s, n] = $need("loop_area_MPa")
  drift_low[s] += $need("change_at_low_stress")
  drift_high[s] += $need("change_at_high_stress")
  last_low[s] = $column["change_at_low_stress"]
}
function drift(s) {
  return sprintf("%+.2e a cycle at the lowest stress, %+.2e at the highest, over %d cycles; %+.1e in the last", \
                 drift_low[s] / cycles[s], drift_high[s] / cycles[s], cycles[s], last_low[s])
}
function cohesive(s, words) {
  if (!(s in cycles)) return
  statement(words "with cohesion the loops drift to the looser side", "looser", drift(s), drift_low[s] < 0, \
            sprintf("mean change of relative density; without cohesion %+.2e at the lowest stress", drift_low["g0"] / cycles["g0"]))
}
END {
  if (failed) exit 1
  if (!("g0" in cycles) || !("energy-g0.5" in cycles)) { print "verdict: samples with and without bonds are needed" > "/dev/stderr"; exit 1 }
  cohesive("energy-g0.5", "Law `energy`: ")
  cohesive("g0.5", "Law `exponential`: ")
  statement("Without cohesion the loops drift to the denser side", "denser", drift("g0"), drift_low["g0"] > 0, "mean change of relative density")
  m = cycles["g0"] < cycles["energy-g0.5"] ? cycles["g0"] : cycles["energy-g0.5"]
  statement("Without cohesion loops enclose a larger area", "larger", \
            sprintf("%.3f MPa against %.3f in cycle 1, %.3f against %.3f in cycle %d", area["g0", 1], area["energy-g0.5", 1], area["g0", m], area["energy-g0.5", m], m), \
            area["g0", 1] > area["energy-g0.5", 1] && area["g0", m] > area["energy-g0.5", m], "")
  end_of_verdict()
}
