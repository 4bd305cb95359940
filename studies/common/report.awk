# verdict.json (one statement a line, as studies/common/verdict.awk writes it) -> rows of an HTML table, or of a Markdown
# one with -v format=markdown.
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
function html(text) {
  gsub(/&/, "\\&amp;", text)
  gsub(/</, "\\&lt;", text)
  gsub(/>/, "\\&gt;", text)
  return text
}
/"statement":/ {
  agrees = field("agrees")
  word = agrees == "true" ? "agrees" : agrees == "false" ? "differs" : "not judged"
  if (format == "markdown") {
    printf "| %s | %s | %s | %s |\n", cell(field("statement")), cell(field("paper")), cell(field("ours")), word
    next
  }
  printf "<tr class=\"%s\"><td>%s</td><td>%s</td><td>%s</td><td>%s</td><td>%s</td></tr>\n", \
         agrees, html(field("statement")), html(field("paper")), html(field("ours")), word, html(field("note"))
}
