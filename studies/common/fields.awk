# For verdict.json as studies/common/verdict.awk writes it, one statement a line: field(NAME), and a text as a cell of a Markdown table.
function field(name,   start, rest, text, c) {
  start = index($0, "\"" name "\": ")
  if (!start) return ""
  rest = substr($0, start + length(name) + 4)
  if (substr(rest, 1, 1) != "\"") {
    sub(/[,}].*$/, "", rest)
    return rest
  }
  text = ""
  for (start = 2; (c = substr(rest, start, 1)) != "\"" && c != ""; ++start) {
    if (c == "\\") c = substr(rest, ++start, 1)
    text = text c
  }
  return text
}
function cell(text) {
  gsub(/\|/, "\\|", text)
  return text
}
