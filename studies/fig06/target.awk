# The size table of a packing's description (TOML) as CSV.
function numbers(line,   list) {
  sub(/^[^[]*\[/, "", line)
  sub(/\].*$/, "", line)
  gsub(/[ \t]/, "", line)
  return line
}
/^[ \t]*values[ \t]*=/ { diameters = split(numbers($0), diameter, ",") }
/^[ \t]*cumulative[ \t]*=/ { fractions = split(numbers($0), fraction, ",") }
END {
  if (!diameters || diameters != fractions) {
    print FILENAME ": no size table with equally many 'values' and 'cumulative'" > "/dev/stderr"
    exit 1
  }
  print "diameter_mm,cumulative_number"
  for (i = 1; i <= diameters; ++i) printf "%s,%s\n", diameter[i], fraction[i]
}
