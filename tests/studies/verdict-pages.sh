#!/usr/bin/env bash
# verdict-pages.sh POSTPROC: kept verdicts agree with each other. The pages say what the verdict.json files say
# (docs/verdicts.md of all meshes, studies/results/MESH/verdicts.md of one), and the reasons in these files are those
# that the studies give now.
set -euo pipefail
postproc=$(realpath "$1")
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
own=$(mktemp -d)
trap 'rm -rf "$own"' EXIT

fail() { echo "verdict-pages.sh: $1" >&2 && exit 1; }

# One mesh: its page has a paragraph of its own before the verdicts, and what the runs took after them.
pages=0
for page in studies/results/*/verdicts.md; do
  mesh=$(basename "$(dirname "$page")")
  "$postproc" verdicts "$mesh=studies/results/$mesh" >"$own/made"
  sed -n '/^## What the runs took$/q; /^## /,$p' "$page" >"$own/kept"
  diff --ignore-blank-lines "$own/made" "$own/kept" ||
    fail "$page (right) does not say what its verdict.json files say (left)"
  pages=$((pages + 1))
done
[ "$pages" -ge 4 ] || fail "found $pages pages of one mesh, allowed: at least 4"

# All meshes, by the script that writes the page.
mkdir "$own/docs"
ln -s "$PWD/studies" "$own/studies"
(cd "$own" && sh studies/common/verdicts.sh "$postproc")
diff "$own/docs/verdicts.md" docs/verdicts.md ||
  fail 'docs/verdicts.md (right) does not say what the kept verdict.json files say (left)'

# Reasons: one long line of every file that may give them, in which "\" and a line's end stand for nothing.
cat studies/*/*.toml studies/*/*.awk | sed -e :a -e '/\\$/{N;s/\\\n *//;ba' -e '}' | tr '\n' ' ' >"$own/given"
grep -ohE '"why": ?"[^"]*"' studies/results/*/*/verdict.json | sed -E 's/^"why": ?"(.*)"$/\1/' | sort -u >"$own/reasons"
[ -s "$own/reasons" ] || fail 'no kept verdict gives a reason: nothing was checked'
while IFS= read -r reason; do
  grep -qF -- "$reason" "$own/given" || fail "no study gives this kept reason any more: $reason"
done <"$own/reasons"
