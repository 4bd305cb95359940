#!/bin/sh
# report.sh MESH FIGURE...: one HTML page, pictures included, of the studies' results under out/MESH, on standard output.
set -eu
mesh=$1
shift

cat <<HTML
<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<title>mpfem studies, mesh $mesh</title>
<style>
  body { font: 16px/1.45 sans-serif; max-width: 75rem; margin: 2rem auto; padding: 0 1rem; color: #222; }
  table { border-collapse: collapse; margin: 1rem 0; }
  td, th { border: 1px solid #bbb; padding: 0.3rem 0.6rem; text-align: left; vertical-align: top; }
  tr.true td:nth-child(4) { background: #d9f0d9; }
  tr.false td:nth-child(4) { background: #f7d4cf; }
  .pictures { display: flex; flex-wrap: wrap; gap: 1rem; }
  figure { margin: 0; width: 36rem; max-width: 100%; }
  img { width: 100%; }
  figcaption { font-size: 0.85rem; color: #555; }
</style>
</head>
<body>
<h1>Studies, mesh &ldquo;$mesh&rdquo;</h1>
<p>Each table sets what Ku, Zhao, Mollon and Zhao, <cite>Compaction of highly deformable cohesive granular powders</cite>,
state beside what was computed here; the last but one column is computed from the data.</p>
HTML

for figure in "$@"; do
  folder=out/$mesh/$figure
  printf '<h2 id="%s">%s</h2>\n' "$figure" "$(sed -n '1s/^# *//p' "studies/$figure/README.md")"
  # The first paragraph of a study's README is its question.
  # shellcheck disable=SC2016 # the backquotes are Markdown's
  printf '<p>%s</p>\n' "$(awk 'NR > 1 && NF { seen = 1; print } seen && !NF { exit }' "studies/$figure/README.md" |
    sed 's/&/\&amp;/g; s/</\&lt;/g; s/>/\&gt;/g; s/\*\*//g; s/`\([^`]*\)`/<code>\1<\/code>/g')"
  printf '<div class="pictures">\n'
  for picture in "$folder"/*.png; do
    [ -e "$picture" ] || continue
    printf '<figure><img alt="%s" src="data:image/png;base64,' "$(basename "$picture" .png)"
    base64 -w 0 "$picture"
    printf '"><figcaption>%s</figcaption></figure>\n' "$picture"
  done
  printf '</div>\n<table>\n<tr><th>statement</th><th>paper</th><th>here</th><th>verdict</th><th>note</th></tr>\n'
  awk -f studies/common/fields.awk -f studies/common/report.awk "$folder/verdict.json"
  printf '</table>\n<p>Numbers:'
  for table in "$folder"/*.csv; do
    [ -e "$table" ] && printf ' <a href="../%s/%s">%s</a>' "$figure" "$(basename "$table")" "$(basename "$table")"
  done
  printf '</p>\n'
done
printf '</body>\n</html>\n'
