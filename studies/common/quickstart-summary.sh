#!/bin/sh
# quickstart-summary.sh MESH: says what was drawn and what came out.
set -eu
out=out/$1

echo
echo 'Pictures drawn:'
for picture in "$out"/fig*/*.png; do echo "  $picture"; done
echo 'Numbers and verdicts are next to them. Everything on one page:'
echo "  $out/report/index.html"
echo
echo "Mean stress against relative density ($out/fig09/load-density.csv):"
awk -F, -v mesh="$1" '$1 == mesh {
  for (d = 0.60; d <= 0.921; d += 0.08)
    if (last < d * (1 - 1e-6) && $2 >= d * (1 - 1e-6)) printf "  D_r = %.2f   p = %7.2f MPa\n", d, $3
  last = $2
}' "$out/fig09/load-density.csv"
