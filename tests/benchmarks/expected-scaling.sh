#!/usr/bin/env bash
# The estimate of docs/performance.md, "Expected scaling": efficiency of many ranks of 16 cores.
#   tests/benchmarks/expected-scaling.sh [STEP [ELEMENTS]]       prints the table
#   tests/benchmarks/expected-scaling.sh --check PAGE            fails unless the page has the rows of this table
#
# STEP: a whole step on 16 cores, ns per tetrahedron (3.4), ELEMENTS: its elements (1.8). Both as measured with 16
# threads and 2,312 grains. The other constants stand at their names; the page says where they come from.
set -euo pipefail

table() { # STEP ELEMENTS
  awk -v step="$1e-9" -v elements="$2e-9" '
    BEGIN {
      tets = 590; imbalance = 0.1              # tetrahedra of a grain; of ranks with one grain each
      bandwidth = 10e9; latency = 2e-6         # B/s, s
      surface = 3000; neighbours = 26          # B of a border surface; ranks
      collectives = 7e-6; shared = 2           # s per doubling of the ranks; B per grain and step, to all ranks
      count = split("4 16 64 256 1024", ranks, " ")
      printf "| ranks (of 16 cores) |"
      for (i = 1; i <= count; ++i) printf " %s |", ranks[i] == 1024 ? "1,024" : ranks[i]
      print "\n|---|---|---|---|---|---|"
      row("10,000 grains in all", 10000, 0)
      row("100,000 grains in all", 100000, 0)
      row("1,000 grains per rank", 0, 1000)
      for (n = 10; border(n) > inside(n); n += 10) {}
      printf "\nBorder messages are hidden from %d grains per rank on.\n", n
    }
    function row(name, all, per_rank,    i) {
      printf "| efficiency, %s |", name
      for (i = 1; i <= count; ++i) printf " %.2f |", efficiency(per_rank ? per_rank * ranks[i] : all, ranks[i])
      print ""
    }
    function efficiency(grains, ranks,    n, work, time) {
      n = grains / ranks
      work = tets * step * n
      time = work * (1 + imbalance * n ^ (-1 / 3)) + collectives * log(ranks) / log(2) + shared * grains / bandwidth
      if (border(n) > inside(n)) time += border(n) - inside(n)
      return work / time
    }
    # Of n grains, those at the border of their rank: all of them if they are few.
    function at_border(n) { return n < 1 ? 6 * n : 6 * n ^ (2 / 3) }
    function border(n) { return surface * at_border(n) / bandwidth + 2 * neighbours * latency }
    function inside(n) { return n > at_border(n) / 2 ? tets * elements * (n - at_border(n) / 2) : 0 }'
}

measured=(3.4 1.8)
if [[ ${1-} == --check ]]; then
  table "${measured[@]}" | grep '^| efficiency' | while IFS= read -r row; do
    grep -qxF -- "$row" "$2" || { echo "expected-scaling.sh: $2 has not the row $row" >&2; exit 1; }
  done
else
  table "${1:-${measured[0]}}" "${2:-${measured[1]}}"
fi
