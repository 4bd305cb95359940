# awk -f gather.awk -v labels='a;1 b;2' -v header='name,x' -v columns='COLUMN=METRIC.KEY ...' FOLDER...: a table with a row for every
# run's folder: its label (; for ,), then the named keys of its METRIC.json; empty where a metric was refused.
BEGIN {
  rows = split(labels, label, " ")
  many = split(columns, column, " ")
  line = header
  for (i = 1; i <= many; ++i) {
    split(column[i], part, "=")
    line = line "," part[1]
  }
  print line
  for (row = 1; row < ARGC; ++row) {
    line = label[row]
    gsub(/;/, ",", line)
    for (i = 1; i <= many; ++i) {
      split(column[i], part, "=")
      dot = index(part[2], ".")
      line = line "," value_of(ARGV[row] "/" substr(part[2], 1, dot - 1) ".json", substr(part[2], dot + 1))
    }
    print line
  }
  exit failed
}

# Of one `"key": value` a line.
function value_of(file, key,   text, found, line, status) {
  text = "\"" key "\":"
  found = ""
  while ((status = (getline line < file)) > 0)
    if (index(line, text) && found == "") {
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
