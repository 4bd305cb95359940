# Shared: coefficients of fits.json, the first file, and the two surfaces at p_c in MPa and G^c in N/mm: as fitted, and the paper's
# (Eq. 13, with the sign of p_c that makes q rise).
FNR == 1 { ++file }
file == 1 && match($0, /"[ABCD]": \{/) { name = substr($0, RSTART + 1, 1) }
file == 1 && name != "" && /"value":/ {
  sub(/.*: */, "")
  value[name] = $0 + 0
  name = ""
}
function surfaces(p, g) {
  return sprintf("%.6g,%.6g", value["A"] - value["B"] * exp(-p / value["C"]) * exp(-g / value["D"]), \
                 89.93 - 73.64 * exp(-p / 7.51) * exp(-g / 0.11))
}
