# awk -f values-table.awk -v work=FOLDER -v cases='CASE ...' [kept.csv]: case,quantity,value of all cases.
# Sizes, steps and times that stand beside the values belong to runs.awk.
BEGIN {
  FS = ","
  cost = "^(tets|steps|steps_all|processor_time)$"
  print "case,quantity,value"
  many = split(cases, list, " ")
  for (i = 1; i <= many; ++i) {
    file = work "/" list[i] ".values.csv"
    requested[list[i]] = 1
    while ((getline line < file) > 0) {
      split(line, part, ",")
      if (part[1] != "quantity" && part[1] !~ cost) print list[i] "," line
    }
    close(file)
  }
}
!/^#/ && FNR > 1 && !($1 in requested) && $2 !~ cost
