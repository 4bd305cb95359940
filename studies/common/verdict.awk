# Shared by the studies' verdict.awk: writes verdict.json, a list of {statement, paper, ours, agrees, note}, one object
# a line. Call statement() in END, then end_of_verdict().

function quoted(text) {
  gsub(/\\/, "\\\\", text)
  gsub(/"/, "\\\"", text)
  return "\"" text "\""
}

# `agrees`: 1 true, 0 false, -1 null (what it takes to judge is not there; `note` says what).
function statement(text, paper, ours, agrees, note) {
  printf "%s\n  {\"statement\": %s, \"paper\": %s, \"ours\": %s, \"agrees\": %s, \"note\": %s}", \
         (statements++ ? "," : "["), quoted(text), quoted(paper), quoted(ours), \
         (agrees < 0 ? "null" : agrees ? "true" : "false"), quoted(note)
}

function end_of_verdict() { print "\n]" }

function absolute(x) { return x < 0 ? -x : x }

# Columns by the names in a CSV's first row: column[NAME]. What follows a name in brackets (a unit) is left out.
function read_header(   i, name) {
  for (i = 1; i <= NF; ++i) {
    name = $i
    gsub(/"|[ \t\r]|[[(].*$/, "", name)
    column[name] = i
  }
}

# Ends with a message if a column is missing.
function need(name) {
  if (name in column) return column[name]
  print FILENAME ": no column '" name "'" > "/dev/stderr"
  failed = 1
  exit 1
}

# list_add("a, b", "c"): "a, b, c".
function list_add(list, text) { return list (list == "" ? "" : ", ") text }
