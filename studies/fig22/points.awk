# awk -f points.awk strength.csv: strength by confining stress, fracture energy; the names are COMPACTION-Dd-pP.
BEGIN { FS = ","; print "p_c [MPa],G_c [N/mm],q [MPa],uncertainty [MPa],axial_strain [1]" }
FNR > 1 {
  confinement = $1
  sub(/^.*-p/, "", confinement)
  if ($4 == "") print "points: " $1 " has no strength and is left out" > "/dev/stderr"
  else printf "%s,%s,%s,%s,%s\n", confinement, $3, $4, $5, $6
}
