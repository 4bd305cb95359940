# Puts the texts of a --help into a man page that help2man has made, in place of its DESCRIPTION and its list of
# subcommands: help2man runs the lines of examples and of snippets together. Examples and lines that the help indents
# stay as they are, all others become paragraphs.
#
#   awk -f man-text.awk HELP PAGE

function escaped(line) {
  gsub(/\\/, "\\e", line)
  gsub(/-/, "\\-", line)
  if (line ~ /^[.']/) line = "\\&" line
  return line
}

# Whether a line of text goes on in the next one.
function goes_on(line) { return line !~ /[.:]$/ }

function is_kept(line) { return line ~ /^  / || line ~ /^Example: / }

# Prints the lines first … last of text[].
function print_text(first, last,   i, kept) {
  kept = 0
  for (i = first; i <= last; ++i) {
    if (kept != is_kept(text[i])) {
      kept = !kept
      print kept ? ".nf" : ".fi"
    } else if (!kept && i > first && !goes_on(text[i - 1])) {
      print ".br"
    }
    print escaped(text[i])
  }
  if (kept) print ".fi"
}

function print_description() {
  print_text(1, described)
}

function print_subcommands(   k) {
  for (k = 1; k <= named; ++k) {
    print ".TP"
    print "\\fB" escaped(name[k]) "\\fR"
    print_text(begins[k], k < named ? begins[k + 1] - 1 : lines)
  }
}

# ---- the help: text[1 … described] above "Usage:", then the texts of the subcommands, which begin in the 31st column
FNR == NR && /^Usage:/ { described = lines; part = "usage"; next }
FNR == NR && /^Subcommands:/ { part = "subcommands"; next }
FNR == NR && part == "" { text[++lines] = $0; next }
FNR == NR && part == "subcommands" && /^  [a-z]/ {
  name[++named] = $1
  begins[named] = lines + 1
  sub(/^  [^ ]+ */, "")
  if ($0 != "") text[++lines] = $0
  next
}
FNR == NR && part == "subcommands" && /^ / { text[++lines] = substr($0, 31); next }
FNR == NR { next }

# ---- the page
/^\.S[HS]/ {
  replaced = 0
  print
  if ($0 ~ /^\.SH DESCRIPTION/) { print_description(); replaced = 1 }
  if ($0 ~ /^\.SS "?Subcommands:/) { print_subcommands(); replaced = 1 }
  next
}
!replaced
