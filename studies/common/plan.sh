#!/bin/sh
# plan.sh MPFEM SCENARIO OPTIONS...: what `mpfem check` says of a compaction, as a table of one row: tets, steps, memory
# of the model's data, and what a tet-step costs on this machine with that many threads.
set -eu
mpfem=$1
shift
"$mpfem" check "$@" | awk '
  $1 == "packing" { for (i = 2; i <= NF; ++i) if ($i == "tets,") tets = $(i - 1) }
  $1 == "memory" { memory = $2 }
  $1 == "estimate" {
    milliseconds = $2
    for (i = 3; i <= NF; ++i) {
      if ($i == "on") threads = $(i + 1)
      if ($i == "steps:") steps = $(i - 1)
    }
  }
  END {
    if (!(tets > 0 && steps > 0 && threads > 0)) {
      print "plan.sh: the plan of mpfem check is not as expected" > "/dev/stderr"
      exit 1
    }
    print "tets,steps,memory_MB,threads,ns_per_tet_step"
    printf "%d,%d,%s,%d,%.1f\n", tets, steps, memory, threads, milliseconds * 1e6 / tets
  }'
