#!/usr/bin/env bash
# Tables of docs/performance.md from the built-in packing:
#   tests/benchmarks/performance.sh [--large] [MPFEM [PORTABLE_MPFEM [SCALAR_MPFEM]]] > tables.md
#
# MPFEM is the executable to measure (build/bin/mpfem), PORTABLE_MPFEM one of `cmake --preset portable`, which is
# measured with each instruction set that this machine knows, SCALAR_MPFEM one of `cmake -DMPFEM_SCALAR=ON`. Every case
# is measured three times, in turn with the others of its table, and the medians are printed: a shared machine is noisy.
# --large adds packings of 1.6 to 12 million tets (2 GB of memory, a quarter of an hour). Features in a real packing:
# features.sh.
set -euo pipefail

large=
if [[ ${1-} == --large ]]; then large=yes && shift; fi
mpfem=${1:-build/bin/mpfem}
portable=${2-}
scalar=${3-}
cores=$(nproc)
readonly repetitions=3

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# shellcheck source=tests/benchmarks/medians.sh
. "$(dirname "${BASH_SOURCE[0]}")/medians.sh"

# table TITLE; then cases on standard input: NAME | EXECUTABLE | OPTIONS
table() {
  local title=$1 name executable options i=0
  local names=()
  printf '\n### %s\n\n' "$title"
  printf '| case | tets | elements alone | whole step | of it contact | search | memory, bytes per tetrahedron |\n'
  printf '|---|---|---|---|---|---|---|\n'
  local cases
  cases=$(cat)
  for ((repetition = 1; repetition <= repetitions; ++repetition)); do
    i=0
    while IFS='|' read -r name executable options; do
      # shellcheck disable=SC2086 # options are several words
      "$executable" bench --json $options >"$work/$i.$repetition.json"
      names[i]=$name
      i=$((i + 1))
    done <<<"$cases"
  done
  for ((k = 0; k < i; ++k)); do
    printf '| %s ' "${names[k]}"
    printf '| %d ' "$(value "$work/$k.1.json" tets)"
    for key in element_pass_ns_per_tet_step whole_step_ns_per_tet_step contact_ns_per_tet_step search_ns_per_tet_step \
      memory_bytes_per_tet; do
      printf '| %.4g ' "$(median "$key" "$work/$k".*.json)"
    done
    printf '|\n'
  done
}

printf 'ns per tetrahedron and step, medians of %s. ' "$repetitions"
"$mpfem" bench --tets 2000 --grains 4 --steps 5 --threads "$cores" --quiet | head -n 1

for ((t = 1; t <= cores; t *= 2)); do echo "$t threads|$mpfem|--threads $t"; done | table 'Threads'

table 'What a feature costs' <<EOF
tet4, bonds|$mpfem|
tet4|$mpfem|--no-bonds
tet4-anp, bonds|$mpfem|--element tet4-anp
tet4-anp|$mpfem|--element tet4-anp --no-bonds
tet4-patch, bonds|$mpfem|--element tet4-patch
tet4, bonds, mixed|$mpfem|--precision mixed
tet4-anp, bonds, mixed|$mpfem|--element tet4-anp --precision mixed
tet4-patch, bonds, mixed|$mpfem|--element tet4-patch --precision mixed
EOF

{
  for ((t = 1; t <= cores; t *= 2)); do
    for element in tet4 tet4-anp tet4-patch; do
      for precision in double mixed; do
        echo "$element, $precision, $t threads|$mpfem|--element $element --precision $precision --threads $t"
      done
    done
  done
} | table 'Precision'

for grains in 20 80 329 2000 ${large:+8398}; do
  echo "$grains grains|$mpfem|--grains $grains --tets $((600 * grains))"
done | table 'Number of grains, 600 tets each'

{
  for tets in 200000 330000; do echo "about 329 grains|$mpfem|--tets $tets"; done
  if [[ $large ]]; then
    for ((t = 1; t <= cores; t *= 2)); do
      for element in tet4 tet4-anp; do
        echo "$element, $t threads|$mpfem|--tets 1600000 --element $element --threads $t"
      done
    done
    echo "12 million|$mpfem|--tets 12000000 --steps 450"
  fi
} | table 'Mesh size'

if [[ $portable || $scalar ]]; then
  {
    echo "built for this machine|$mpfem|--threads 1"
    if [[ $scalar ]]; then echo "scalar|$scalar|--threads 1"; fi
    for level in ${portable:+v4 v3 v2}; do
      # One that this machine does not know would measure the next plainer one a second time.
      [[ $level == v4 ]] && ! grep -qw avx512dq /proc/cpuinfo && continue
      [[ $level == v3 ]] && ! grep -qw avx2 /proc/cpuinfo && continue
      printf '#!/bin/sh\nMPFEM_INSTRUCTION_SET=%s exec "%s" "$@"\n' "$level" "$portable" >"$work/$level"
      chmod +x "$work/$level"
      echo "x86-64-$level|$work/$level|--threads 1"
    done
  } | table 'Instruction sets'
fi
