#!/usr/bin/env bash
# The compiled loops over contact points prefetch the nodes of facets ahead of their turn, the records of reactions and
# the rows that these act on. GCC removed some of these once without a word (common/prefetch.hpp).
#
#   prefetches.sh MPFEM     MPFEM: the executable
#
# Exit code 0: they are there; 1: one is missing; 77: no objdump.
set -euo pipefail
command -v objdump >/dev/null || exit 77

objdump -d --no-show-raw-insn --demangle "$1" | awk '
  /^[0-9a-f]+ <.*>:$/ { name = $0 }
  /[ \t](prefetch|prfm)/ {
    if (name ~ /PointEvaluation|prefetch_ahead_of|prefetch_nodes/) points++
    if (name ~ /prefetched_reactions/) records++
    else if (name ~ /contact_reactions/) rows++
  }
  END {
    if (!points) print "no prefetches in the loop over contact points"
    needed = records ? 1 : 3 # those of records may stand in the same function, at most two
    if (rows < needed) print "no prefetches of rows in the loop over reactions"
    exit !points || rows < needed
  }'
