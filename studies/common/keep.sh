#!/bin/sh
# keep.sh MESH BIN FIGURE...: copies the small results of figures from out/MESH to studies/results/MESH (with another
# element or surface MESH-ELEMENT or MESH-SURFACE), with what their runs took (out/MESH/times.csv, plan.csv) and from
# what they came (provenance.txt: program, packing, settings of every run). Of figures that are not at hand, times and
# provenance stay as they were kept. The verdicts of all figures kept for that mesh go to verdicts.md there, those of
# all meshes side by side to docs/verdicts.md. Pictures and tables above 20 kB, which make writes again from the runs,
# are not kept.
set -eu
mesh=$1
mpfem=$2/mpfem
postproc=$2/postproc
shift 2
kept=studies/results/$mesh
copied=
for figure in "$@"; do
  [ -e "out/$mesh/$figure/verdict.json" ] || {
    echo "keep.sh: out/$mesh/$figure has no verdict.json: left out" >&2 && continue
  }
  mkdir -p "$kept/$figure"
  rm -f "$kept/$figure"/*.png "$kept/$figure"/*.json "$kept/$figure"/*.csv # of other settings
  find "out/$mesh/$figure" -maxdepth 1 -type f \( -name '*.json' -o -name '*.csv' -size -20k \) \
    -exec cp {} "$kept/$figure/" \;
  copied=$copied${copied:+, }$figure
done
[ -n "$copied" ] || { echo "keep.sh: found no figure in out/$mesh, allowed: one or more, made before" >&2 && exit 2; }
{
  echo "# Verdicts, MESH=$mesh"
  echo
  echo 'Statements of Ku, Zhao, Mollon and Zhao, compared with the results of the studies in this folder.'
  echo 'The verdict.json files say how each statement is judged and why it differs. Studies that are not figures are'
  echo 'compared with their own expectations.'
  "$postproc" verdicts "$mesh=$kept"
  # Times of the figures at hand take the place of those kept before; of the plan, what is not this machine's.
  kept_times=$kept/times.csv
  [ -e "$kept_times" ] || head -n 1 "out/$mesh/times.csv" >"$kept_times"
  awk -F, 'FNR == 1 { if (NR == 1) header = $0; next } { row[$1] = $0 }
    END { print header; for (i = 3; i <= 26; ++i) { f = sprintf("fig%02d", i); if (f in row) print row[f] } }' \
    "$kept_times" "out/$mesh/times.csv" >"$kept_times.partial"
  mv "$kept_times.partial" "$kept_times"
  [ ! -e "out/$mesh/plan.csv" ] || cut -d, -f1-3 "out/$mesh/plan.csv" >"$kept/plan.csv"
  printf '\n## What the runs took\n\nA run that several studies use counts for the first of them.\n\n'
  echo '| study | runs | counted before | tet-steps | wall time of the others, s | times threads, s |'
  echo '|---|---|---|---|---|---|'
  awk -F, 'NR > 1 { printf "| %s | %d | %d | %s | %s | %s |\n", $1, $2, $3, $4, $5, $6 }' "$kept/times.csv"
} >"$kept/verdicts.md.partial"
mv "$kept/verdicts.md.partial" "$kept/verdicts.md"
# Runs at hand take the place of those kept before, which need not be here. The first line says for which figures which
# version was the last.
provenance=$kept/provenance.txt
version=$("$mpfem" --version | sed 's/^mpfem //')
before=$(head -n 1 "$provenance" 2>/dev/null || true)
case "$before; " in
"; ") before=$version ;;
"$version; " | *"$copied: $version; "*) ;;
*) before="$before; $copied: $version" ;;
esac
{
  echo "$before"
  echo 'settings of packings and runs; a number of 64 hexadecimal digits is the SHA-256 of the file before it'
  {
    tail -n +3 "$provenance" 2>/dev/null || true
    for settings in out/packings/*/*.settings "out/$mesh"/*/run.settings "out/$mesh"/*/*/run.settings; do
      [ -e "$settings" ] || continue
      printf '%s: %s\n' "${settings%.settings}" "$(cat "$settings")"
    done
  } | awk -F': ' '!($1 in line) { order[++n] = $1 } { line[$1] = $0 }
    END { for (i = 1; i <= n; ++i) print line[order[i]] }'
} >"$provenance.partial"
mv "$provenance.partial" "$provenance"
sh studies/common/verdicts.sh "$postproc"
