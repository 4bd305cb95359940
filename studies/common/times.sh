#!/bin/sh
# times.sh POSTPROC FIGURE...: a table of what the runs of each figure took, from their own records. A run that
# several figures use counts for the first of them. Which runs a figure needs is what make would do for it if nothing
# were there. To be called by make, which hands on MESH, ELEMENT and SURFACE.
set -eu
postproc=$1
shift
seen=$(mktemp)
trap 'rm -f "$seen"' EXIT
echo 'study,runs,of_them_counted_before,tet_steps,wall_time_s,core_time_s,missing'
for figure in "$@"; do
  runs=0 before=0 missing=0
  set --
  for run in $(make --no-print-directory -n -B -f Makefile.studies "$figure" 2>/dev/null |
    sed -n 's|.*mpfem run [^ ]* -o \([^ ]*\)/work/run\.h5 .*|\1/run.h5|p' | sort -u); do
    if [ ! -e "$run" ]; then
      missing=$((missing + 1))
      continue
    fi
    runs=$((runs + 1))
    if grep -qxF "$run" "$seen"; then
      before=$((before + 1))
    else
      echo "$run" >>"$seen"
      set -- "$@" "$run"
    fi
  done
  [ $((runs + missing)) -eq 0 ] ||
    echo "$figure,$runs,$before,$("$postproc" cost "$@" | cut -d, -f2-),$missing"
done
