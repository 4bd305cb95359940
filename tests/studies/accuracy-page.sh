#!/usr/bin/env bash
# accuracy-page.sh: the page docs/speed-against-error, made anew from its text (studies/accuracy/page.md) and from the
# CSV files beside it, is the one that is kept. Exit code 0: it is; 1: it is not, and the differences are printed.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
page=docs/speed-against-error
study=studies/accuracy
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

awk '$1 == "@table" { print $2 }' "$study/page.md" | while read -r table; do
  awk -f studies/common/verdict.awk -f "$study/tables.awk" -v table="$table" \
    "$page/points.csv" "$page/values.csv" "$page/references.csv" >"$work/$table.md"
done
awk -v tables="$work" -f "$study/page.awk" "$study/page.md" | diff "$page/README.md" -
