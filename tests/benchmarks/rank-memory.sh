#!/usr/bin/env bash
# How much memory each rank takes when every rank has as many grains as before: tests/benchmarks/rank-memory.sh [BIN
# [GRAINS [SIZE]]] > rank-memory.md
#
# BIN holds the executables of a build with MPI. 1, 2, 4, 8 and 16 ranks begin to press GRAINS (500) grains each of the
# paper's powder, meshed with SIZE (0.04 mm), and write a checkpoint and a snapshot. Memory does not depend on the
# number of cores, so there may be more ranks than cores. Needs GNU time. Some ten minutes on two idle cores.
set -euo pipefail

bin=$(realpath "${1:-build/bin}")
grains=${2:-500}
size=${3:-0.04}
top=$(realpath "$(dirname "${BASH_SOURCE[0]}")/../..")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cp "$top/pack-gen/examples/mcc_ph102.toml" "$top/studies/box-size/compaction.toml" "$work"
cd "$work"

printf '| ranks | grains | tetrahedra | memory of the first rank, MB | most of another, MB |\n|---|---|---|---|---|\n'
for ranks in 1 2 4 8 16; do
  count=$((ranks * grains))
  side=$(awk -v count="$count" 'BEGIN { printf("%.4f", 0.95 * (count / 329) ^ (1 / 3)) }')
  "$bin/pack-gen" spheres mcc_ph102.toml -o spheres.h5 --quiet --set count="$count" --set "box=[$side,$side,$side]" \
    --set size_scale_tolerance=0.02
  "$bin/pack-gen" mesh spheres.h5 --size "$size" -o packing.h5 --quiet
  # shellcheck disable=SC2016 # the ranks have the variable
  mpirun --oversubscribe -n "$ranks" bash -c '/usr/bin/time -o "memory.$OMPI_COMM_WORLD_RANK" -f "%M" "$@"' rank \
    "$bin/mpfem" run compaction.toml -o run.h5 --threads 1 --quiet --set stages.0.relative_density=0.5525 \
    --set output.snapshot_at_stage_end=true </dev/null
  tets=$("$bin/mpfem" check compaction.toml | sed -n 's/^packing .* \([0-9]*\) tets.*/\1/p')
  others=$(for ((rank = 1; rank < ranks; ++rank)); do cat "memory.$rank"; done | sort -n | tail -n 1)
  awk -v ranks="$ranks" -v count="$count" -v tets="$tets" -v first="$(cat memory.0)" -v others="$others" 'BEGIN {
    kib = 1024 / 1e6 # MB
    other = others ? sprintf("%.0f", others * kib) : ""
    printf("| %d | %d | %s | %.0f | %s |\n", ranks, count, tets, first * kib, other) }'
  rm -f ./*.h5 memory.*
done
