# awk -f verdict.awk -f spread.awk -v columns='NAME NAME ...' TABLE.csv TABLE.csv ...: one table per packing, rows known by their
# first field -> a row for each name of the first table: in how many packings all columns could be measured, and mean and
# standard deviation (of the sample, N - 1) of each column over these. The deviation of a single packing is left empty.
BEGIN {
  FS = ","
  many = split(columns, wanted, " ")
}
FNR == 1 {
  split("", column)
  read_header()
  ++tables
  for (c = 1; c <= many; ++c) {
    at[c] = need(wanted[c])
    if (tables == 1) title[c] = $at[c]
  }
  next
}
{
  if (tables == 1) row[++rows] = $1
  for (c = 1; c <= many; ++c) if ($at[c] == "") next
  n = ++packings[$1]
  # Welford's update: no difference of large sums.
  for (c = 1; c <= many; ++c) {
    change = $at[c] - mean[$1, c]
    mean[$1, c] += change / n
    squares[$1, c] += change * ($at[c] - mean[$1, c])
  }
}
END {
  if (failed) exit 1
  line = "name,packings"
  for (c = 1; c <= many; ++c) {
    unit = title[c]
    if (!sub(/^[^[]*/, "", unit)) unit = ""
    line = line "," title[c] "," wanted[c] "_deviation" (unit == "" ? "" : " " unit)
  }
  print line
  for (r = 1; r <= rows; ++r) {
    n = packings[row[r]] + 0
    line = row[r] "," n
    for (c = 1; c <= many; ++c)
      line = line "," (n > 0 ? sprintf("%.10g", mean[row[r], c]) : "") "," (n > 1 ? sprintf("%.10g", sqrt(squares[row[r], c] / (n - 1))) : "")
    print line
  }
}
