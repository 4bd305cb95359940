# awk -f ../common/verdict.awk -f section-mean.awk out/MESH/fig21/section-G.csv...: the cut boundaries of a section in a row each:
# bonded length in mm, and of that length the mean damage and the share that is broken.
BEGIN { FS = ","; print "fracture_energy_N_per_mm,bonded_length_mm,mean_damage,broken_share" }
function put() { if (g != "") printf "%s,%.6g,%.6g,%.6g\n", g, bonded, (bonded ? sum / bonded : 0), (bonded ? broken / bonded : 0) }
FNR == 1 {
  put()
  read_header()
  g = FILENAME
  sub(/^.*section-/, "", g)
  sub(/\.csv$/, "", g)
  bonded = sum = broken = 0
  next
}
{
  # Where there is no bond damage is -1.
  if ($need("damage_1") < 0 || $need("damage_2") < 0) next
  length_mm = $need("length")
  d = ($column["damage_1"] + $column["damage_2"]) / 2
  bonded += length_mm
  sum += d * length_mm
  if (d >= 0.99) broken += length_mm
}
END { put(); exit failed }
