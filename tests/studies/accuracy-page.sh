#!/usr/bin/env bash
# accuracy-page.sh: the page docs/speed-against-error, made anew from its text (studies/accuracy/page.md) and from the
# CSV files beside it, is the one that is kept. Exit code 0: it is; 1: it is not, and the differences are printed.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
page=docs/speed-against-error
sh studies/accuracy/page.sh "$page/points.csv" "$page/values.csv" "$page/references.csv" | diff "$page/README.md" -
