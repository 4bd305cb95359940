#!/usr/bin/env bash
# What several ranks cost: tests/benchmarks/ranks.sh [MPFEM [PAIRS [TETS]]] > ranks.md
#
# MPFEM is the executable of a build with MPI (build/bin/mpfem of `./bootstrap --mpi build`). Three tables, of the
# built-in packing of `mpfem bench`: two ranks of one thread against two threads of one process, PAIRS times (13) in
# turn on TETS tetrahedra (200,000); messages, and memory, for several numbers of ranks and grains. Messages and memory
# do not depend on the number of cores, so there may be more ranks than those. Some ten minutes on two idle cores.
set -euo pipefail

mpfem=${1:-build/bin/mpfem}
pairs=${2:-13}
tets=${3:-200000}
tets_of_grain=600

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# shellcheck source=tests/benchmarks/medians.sh
. "$(dirname "${BASH_SOURCE[0]}")/medians.sh"

# bench RANKS THREADS FILE OPTIONS...
bench() {
  local launcher=()
  (($1 == 1)) || launcher=(mpirun --oversubscribe -n "$1")
  "${launcher[@]}" "$mpfem" bench --threads "$2" --json "${@:4}" >"$3" </dev/null # mpirun reads what others need
}

for ((pair = 1; pair <= pairs; ++pair)); do
  bench 1 2 "$work/threads.$pair.json" --tets "$tets" --grains $((tets / tets_of_grain + 1))
  bench 2 1 "$work/ranks.$pair.json" --tets "$tets" --grains $((tets / tets_of_grain + 1))
  for kind in threads ranks; do value "$work/$kind.$pair.json" whole_step_ns_per_tet_step; done | paste -s -d ' '
done >"$work/pairs"

# quartile Q: of the speed of two ranks over that of two threads
quartile() {
  awk '{ print $1 / $2 }' "$work/pairs" | sort -g | sed -n "$((1 + ($1 * (pairs - 1) + 2) / 4))p"
}
printf '### Two ranks of one thread against two threads: %s pairs in turn, %s grains, %s tets\n\n' "$pairs" \
  "$(value "$work/ranks.1.json" grains)" "$(value "$work/ranks.1.json" tets)"
printf '| two threads, ns per tet-step | two ranks | wait for messages | speed of ranks over threads, median | '
printf 'quartiles |\n|---|---|---|---|---|\n'
printf '| %.3g | %.3g | %.2g | %.2f | %.2f, %.2f |\n' "$(median whole_step_ns_per_tet_step "$work"/threads.*.json)" \
  "$(median whole_step_ns_per_tet_step "$work"/ranks.*.json)" \
  "$(median message_wait_ns_per_tet_step "$work"/ranks.*.json)" "$(quartile 2)" "$(quartile 1)" "$(quartile 3)"

printf '\n### Messages and memory\n\n'
printf '| ranks | grains | tets | kB per step of the rank that sends most | memory of the first rank, MB | of all |\n'
printf '|---|---|---|---|---|---|\n'
while read -r ranks grains; do
  file=$work/size.json
  bench "$ranks" 1 "$file" --grains "$grains" --tets $((tets_of_grain * grains)) --steps 15
  for key in grains tets memory_bytes_per_tet memory_bytes_of_first_rank sent_bytes_per_step; do
    printf '%s ' "$(value "$file" "$key")"
  done | awk -v ranks="$ranks" '{
    all = $2 * $3 / 1e6
    several = (ranks > 1)
    printf("| %d | %d | %d | %s | %.0f | %.0f |\n", ranks, $1, $2, several ? sprintf("%.3g", $5 / 1e3) : "",
           several ? $4 / 1e6 : all, all) }'
done <<END
1 329
2 30
2 329
2 2000
4 329
8 329
END
