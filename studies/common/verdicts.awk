# awk -f fields.awk -f verdicts.awk -v meshes='coarse smoke' studies/results/MESH/STUDY/verdict.json...: Markdown, for each study and mesh how
# many statements agree, then all statements with what each mesh found.
FNR == 1 {
  count = split(FILENAME, part, "/")
  mesh = part[count - 2]
  study = part[count - 1]
  if (!(study in known)) {
    known[study] = 1
    studies[++many] = study
  }
}
/"statement":/ {
  text = field("statement")
  if (!((study, text) in seen)) {
    seen[study, text] = 1
    statement[study, ++rows[study]] = text
    paper[study, text] = field("paper")
  }
  agrees = field("agrees")
  word = agrees == "true" ? "agrees" : agrees == "false" ? "**differs**" : "not judged"
  ++number[study, mesh, agrees]
  ++number["all", mesh, agrees]
  found[study, text, mesh] = word ": " field("ours")
}
function tally(study, mesh,   yes, no, open) {
  yes = number[study, mesh, "true"] + 0
  no = number[study, mesh, "false"] + 0
  open = number[study, mesh, "null"] + 0
  return yes + no + open ? yes " / " no " / " open : ""
}
END {
  columns = split(meshes, column, " ")
  head = "| study |"
  rule = "|---|"
  for (c = 1; c <= columns; ++c) {
    head = head " " column[c] " |"
    rule = rule "---|"
  }
  print "Statements that agree / differ / could not be judged:\n\n" head "\n" rule
  # fig03, fig04 … in order, whichever mesh came first.
  for (i = 2; i <= many; ++i)
    for (k = i; k > 1 && studies[k] < studies[k - 1]; --k) {
      text = studies[k]
      studies[k] = studies[k - 1]
      studies[k - 1] = text
    }
  for (s = 1; s <= many + 1; ++s) {
    study = s > many ? "all" : studies[s]
    line = s > many ? "| **all** |" : "| [" study "](#" study ") |"
    for (c = 1; c <= columns; ++c) line = line " " tally(study, column[c]) " |"
    print line
  }
  sub(/study/, "statement | paper", head)
  for (s = 1; s <= many; ++s) {
    study = studies[s]
    print "\n## " study "\n\n[How it is made and judged](../studies/" study "/README.md)\n\n" head "\n|---" rule
    for (r = 1; r <= rows[study]; ++r) {
      text = statement[study, r]
      line = "| " cell(text) " | " cell(paper[study, text]) " |"
      for (c = 1; c <= columns; ++c) line = line " " cell(found[study, text, column[c]]) " |"
      print line
    }
  }
}
