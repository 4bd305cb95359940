#!/usr/bin/env bash
# keep.sh POSTPROC: what is kept of one figure, or of none, leaves the provenance of the others as it was. Exit code 1:
# it does not.
set -euo pipefail
bin=$(dirname "$(realpath "$1")")
here=$(realpath "$(dirname "${BASH_SOURCE[0]}")/../..")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
mkdir -p bin studies docs out/smoke/{fig10,branches/a,compactions/b} out/packings/smoke
cp -r "$here/studies/common" studies/
ln -s "$bin/postproc" bin/postproc
printf '#!/bin/sh\necho "mpfem 9.9 (commit abc)"\n' >bin/mpfem
chmod +x bin/mpfem
# What the page of all verdicts reads is no matter here.
printf '#!/bin/sh\n' >studies/common/verdicts.sh
echo '[]' >out/smoke/fig10/verdict.json
printf 'study,runs\nfig10,1\n' >out/smoke/times.csv
echo 'programme 1 --set a=1' >out/smoke/branches/a/run.settings
echo 'programme 2' >out/smoke/compactions/b/run.settings
echo 'size 0.03' >out/packings/smoke/mesh-0.03.settings

code=0
heading='settings of packings and runs; a number of 64 hexadecimal digits is the SHA-256 of the file before it'
# kept LINES: what keep.sh leaves has these lines.
kept() {
  sh studies/common/keep.sh smoke bin fig10
  diff <(printf '%s\n' "$@") studies/results/smoke/provenance.txt || { echo "keep.sh: see above" && code=1; }
}
mesh='out/packings/smoke/mesh-0.03: size 0.03' b='out/smoke/compactions/b/run: programme 2'
kept '9.9 (commit abc)' "$heading" "$mesh" 'out/smoke/branches/a/run: programme 1 --set a=1' "$b"

other='out/smoke/branches/c/run: programme 3 --set label=x: y'
printf '%s\n' '0.1 (commit old); fig12: 0.2 (commit middle)' "$heading" "$other" \
  'out/smoke/branches/a/run: programme 1' >studies/results/smoke/provenance.txt
merged=('0.1 (commit old); fig12: 0.2 (commit middle); fig10: 9.9 (commit abc)' "$heading" "$other"
  'out/smoke/branches/a/run: programme 1 --set a=1' "$mesh" "$b")
kept "${merged[@]}"
kept "${merged[@]}"

# Without figures nothing is kept, and what was kept stays.
! sh studies/common/keep.sh smoke bin fig11 2>message || { echo 'keep.sh: keeps what is not there' && code=1; }
grep -q 'found no figure in out/smoke, allowed' message || { cat message && code=1; }
diff <(printf '%s\n' "${merged[@]}") studies/results/smoke/provenance.txt || { echo 'keep.sh: see above' && code=1; }
exit "$code"
