# awk -f fields.awk -f report.awk: verdict.json -> rows of an HTML table, or of a Markdown
# one with -v format=markdown.
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
