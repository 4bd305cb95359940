#!/usr/bin/env bash
# tests/studies/killed-study.sh BIN [FIGURE [RUN]]: makes a study on the small packing twice, once undisturbed and once
# with make and its runs killed again and again, and compares every CSV table and fit. BIN: folder of the executables,
# FIGURE: fig10, RUN: as for make, e.g. 'srun -n1 -c1 --mem=1000'. Works in clones of this repository in a temporary
# folder; some minutes. Exit code 0: all are the same.
set -euo pipefail
bin=$(realpath "$1")
figure=${2:-fig10}
runner=${3:-}
here=$(realpath "$(dirname "${BASH_SOURCE[0]}")/../..")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

for name in undisturbed disturbed; do
  git clone --quiet "$here" "$work/$name"
  mkdir "$work/$name/out"
  [ ! -e "$here/out/packings" ] || cp -r "$here/out/packings" "$work/$name/out/"
done
study=(make -f Makefile.studies "$figure" MESH=smoke BIN="$bin" THREADS=1 RUN="$runner" -j2)
runs() { pgrep -f "^$bin/mpfem run .* -o out/smoke" || true; }

cd "$work/undisturbed"
echo "undisturbed: $(date +%T)"
"${study[@]}" >"$work/undisturbed.log" 2>&1

cd "$work/disturbed"
killed=0
for signal in 'TERM make' 'KILL run' 'TERM run' 'KILL make' 'INT make' 'KILL run' 'TERM make' 'KILL make'; do
  setsid --wait "${study[@]}" >>"$work/disturbed.log" 2>&1 &
  waiting=$!
  sleep $((4 + RANDOM % 6))
  maker=$(pgrep -f "^make -f Makefile.studies $figure MESH=smoke BIN=$bin" | head -n 1 || true)
  case $signal in
  *make) victim=$maker ;;
  *) victim=$(runs | head -n 1) ;;
  esac
  if [ -n "$victim" ] && kill -s "${signal% *}" "$victim" 2>/dev/null; then
    killed=$((killed + 1))
    echo "killed: $signal at $(date +%T)"
  fi
  wait "$waiting" || true
  # What outlives its make goes on to its end, and would refuse the next make's run of the same name.
  while [ -n "$(runs)" ]; do sleep 0.5; done
done
echo "to the end: $(date +%T)"
"${study[@]}" >>"$work/disturbed.log" 2>&1

cd "$work/undisturbed/out/smoke/$figure"
tables=0
for table in *.csv fits.json; do
  [ -e "$table" ] || continue
  cmp "$table" "$work/disturbed/out/smoke/$figure/$table"
  tables=$((tables + 1))
done
echo "$figure: $killed times killed, $tables tables alike to the byte"
[ "$killed" -gt 3 ] && [ "$tables" -gt 0 ]
