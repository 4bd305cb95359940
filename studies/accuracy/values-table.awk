# awk -f values-table.awk -v work=FOLDER -v cases='CASE ...' [kept.csv]: case,quantity,value of all cases.
BEGIN {
  FS = ","
  print "case,quantity,value"
  many = split(cases, list, " ")
  for (i = 1; i <= many; ++i) {
    file = work "/" list[i] ".values.csv"
    requested[list[i]] = 1
    while ((getline line < file) > 0) if (line !~ /^quantity/) print list[i] "," line
    close(file)
  }
}
!/^#/ && FNR > 1 && !($1 in requested) && $2 !~ /^(tets|steps|steps_all)$/
