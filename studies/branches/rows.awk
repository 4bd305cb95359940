# awk -v fields=N -f rows.awk TABLE.csv: its rows as words for make: fields apart by |, blanks inside a field as ;, an empty
# field as -. The last field may hold commas.
NR > 1 && NF && !/^#/ {
  row = ""
  rest = $0
  for (i = 1; i < fields; ++i) {
    comma = index(rest, ",")
    field = comma ? substr(rest, 1, comma - 1) : rest
    rest = comma ? substr(rest, comma + 1) : ""
    row = row (field == "" ? "-" : field) "|"
  }
  row = row (rest == "" ? "-" : rest)
  gsub(/ +/, ";", row)
  print row
}
