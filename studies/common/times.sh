#!/bin/sh
# times.sh MESH POSTPROC FIGURE...: a table of what the runs of each figure took, from their own records. A run that several
# figures use counts for the first of them. Which runs a figure needs is what make would do for it if nothing were there.
set -eu
mesh=$1
postproc=$2
shift 2
summary=$(mktemp)
seen=$(mktemp)
trap 'rm -f "$summary" "$seen"' EXIT
echo 'study,runs,of_them_counted_before,tet_steps,wall_time_s,core_time_s,missing'
for figure in "$@"; do
  make --no-print-directory -n -B -f Makefile.studies "MESH=$mesh" "$figure" 2>/dev/null |
    sed -n 's|.*mpfem run [^ ]* -o \([^ ]*\.h5\) .*|\1|p' | sed 's|/work/run\.h5$|/run.h5|; s|/new-|/|' | sort -u |
    while read -r run; do
      if [ ! -e "$run" ]; then
        echo 'missing'
      elif grep -qxF "$run" "$seen"; then
        echo 'before'
      else
        echo "$run" >>"$seen"
        "$postproc" summary "$run" --quiet -o "$summary" >/dev/null
        awk -F'[:,]' '/"threads"/ { threads = $2 } /"wall_time_s"/ { wall = $2 } /"ns_per_tet_step"/ { cost = $2 }
          END { print wall, threads, cost }' "$summary"
      fi
    done |
    awk -v study="$figure" '
      $1 == "missing" { ++missing; next }
      { ++runs }
      $1 == "before" { ++before; next }
      { wall += $1; core += $1 * $2; steps += $3 > 0 ? $1 / $3 * 1e9 : 0 }
      END { if (runs + missing) printf "%s,%d,%d,%.4g,%.1f,%.1f,%d\n", study, runs, before, steps, wall, core, missing }'
done
