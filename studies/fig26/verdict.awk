# awk -f ../common/verdict.awk -f verdict.awk ../fig25/cycles.csv
BEGIN { FS = "," }
FNR == 1 { read_header(); next }
{
  s = $need("sample")
  n = $need("cycle")
  cycles[s] = n
  plastic[s, n] = $need("plastic_dissipation_mJ")
  damage[s, n] = $need("damage_dissipation_mJ")
  plastic_sum[s] += plastic[s, n]
  damage_sum[s] += damage[s, n]
}
function decays(s, words, value,   m, change) {
  m = cycles[s]
  change = value[s, m] ? absolute(value[s, m] - value[s, m - 1]) / value[s, 1] : 0
  statement(words " falls from cycle to cycle and becomes steady", "falls, then steady", \
            sprintf("%.3g mJ in cycle 1, %.3g and %.3g in the last two", value[s, 1], value[s, m - 1], value[s, m]), \
            value[s, m] < value[s, 1] && change <= 0.1, "taken as steady: the last change is at most 10 % of the first value")
}
END {
  if (failed) exit 1
  c = "energy-g0.5"
  if (!("g0" in cycles) || !(c in cycles) || cycles["g0"] < 2 || cycles[c] < 2) { print "verdict: two cycles with and without bonds are needed" > "/dev/stderr"; exit 1 }
  ratio = damage_sum[c] > 0 ? plastic_sum[c] / damage_sum[c] : 0
  statement("With cohesion plastic dissipation is three orders of magnitude above that of damage", "10^3", \
            ratio ? sprintf("%.1e over %d cycles", ratio, cycles[c]) : "no damage", ratio >= 300 && ratio <= 3000, "taken as agreement: 300 ... 3000")
  ratio = plastic_sum["g0"] / plastic_sum[c]
  m = cycles[c] < cycles["g0"] ? cycles[c] : cycles["g0"]
  statement("Without cohesion plastic dissipation is about twice that with cohesion", "about 2", \
            sprintf("%.2f over all cycles, %.2f in cycle %d", ratio, plastic["g0", m] / plastic[c, m], m), ratio >= 1.4 && ratio <= 2.8, "taken as agreement: 1.4 ... 2.8")
  decays(c, "With cohesion: plastic dissipation", plastic)
  decays("g0", "Without cohesion: plastic dissipation", plastic)
  decays(c, "With cohesion: dissipation by damage", damage)
  if (damage_sum["g0.5"] > 0)
    statement("The same ratio with the law `exponential`", "10^3", \
              sprintf("%.1e", plastic_sum["g0.5"] / damage_sum["g0.5"]), \
              plastic_sum["g0.5"] / damage_sum["g0.5"] >= 300 && plastic_sum["g0.5"] / damage_sum["g0.5"] <= 3000, "taken as agreement: 300 ... 3000")
  end_of_verdict()
}
