# awk -f gather.awk -v root=out/MESH/branches -v rows='NAME;E;G ...' -v columns='COLUMN=PROGRAMME/METRIC.KEY ...': a table with a row for
# every NAME, its grains' Young's modulus and its bonds' fracture energy: KEY of root/NAME-PROGRAMME/METRIC.json, empty where that
# was refused. ~ in COLUMN stands for a blank.
BEGIN {
  many = split(columns, column, " ")
  line = "name,youngs_modulus [MPa],fracture_energy [N/mm]"
  for (i = 1; i <= many; ++i) {
    at = index(column[i], "=")
    title = substr(column[i], 1, at - 1)
    gsub(/~/, " ", title)
    line = line "," title
    source[i] = substr(column[i], at + 1)
  }
  print line
  n = split(rows, row, " ")
  for (r = 1; r <= n; ++r) {
    split(row[r], part, ";")
    line = part[1] "," part[2] "," part[3]
    for (i = 1; i <= many; ++i) {
      dot = index(source[i], ".")
      line = line "," value_of(root "/" part[1] "-" substr(source[i], 1, dot - 1) ".json", substr(source[i], dot + 1))
    }
    print line
  }
  exit failed
}

# Of one `"key": value` a line, the first.
function value_of(file, key,   text, found, line, status) {
  text = "\"" key "\":"
  found = ""
  while ((status = (getline line < file)) > 0)
    if (found == "" && index(line, text)) {
      found = substr(line, index(line, text) + length(text))
      gsub(/[ ",]|null/, "", found)
    }
  if (status < 0) {
    print "gather: " file " cannot be read" > "/dev/stderr"
    failed = 1
  }
  close(file)
  return found
}
