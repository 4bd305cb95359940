# awk -f summary.awk cases.csv NAME.errors.csv...
BEGIN { FS = "," }
FNR == NR { if (FNR > 1) row[$1] = $0; next }
FNR == 1 { next }
{
  name = FILENAME
  sub(/.*\//, "", name)
  sub(/\.errors\.csv$/, "", name)
  split(row[name], c, ",")
  if (!header++) print "case,hardening,approach [R],strength [MPa],fineness,speed_factor,penalty_factor,mean_error,largest_error,largest_error_similarity,pull_off_over_similarity,element,unloading_error_similarity"
  printf "%s,%s,%s,%s,%s,%s,%s,%s,%s,%s,%s,%s,%s\n", name, c[2], c[3], c[4], c[5], c[6], c[8], $1, $2, $3, $5, c[9], $7
}
