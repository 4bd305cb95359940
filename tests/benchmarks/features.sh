#!/usr/bin/env bash
# What each feature of a scenario costs: tests/benchmarks/features.sh PACKING.h5 [MPFEM] > features.md
#
# Compacts the packing (pack-gen mesh) to a relative density of 0.90, with bonds, without, and with hardening from a
# table, and measures steps of what follows with one feature after the other on or off. Every case is measured three
# times, in turn with the others, and the medians are printed: a shared machine is noisy. 329 grains of 600 tets take
# ten minutes.
set -euo pipefail

packing=${1:?usage: features.sh PACKING.h5 [MPFEM]}
mpfem=${2:-build/bin/mpfem}
readonly repetitions=3

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# scenario HARDENING BOND: the compaction after Table 1 of Ku, Zhao, Mollon and Zhao
scenario() {
  cat <<EOF
packing = "$(realpath "$packing")"
[material]
density = 1.55e-9
youngs_modulus = 5000.0
poissons_ratio = 0.3
[material.hardening]
$1
$2
[contact]
surface = "facets"
[element]
type = "tet4"
[output]
snapshot_at_stage_end = false
EOF
}
power='law = "power"
yield_stress = 25.0
coefficient = 125.0
exponent = 0.3'
# The same flow stress by straight lines between 24 points.
table=$(awk 'BEGIN {
  x = "0"; y = "25"
  for (i = 0; i < 23; ++i) { e = 1e-4 * exp(i * log(2e4) / 22); x = x ", " e; y = y ", " 25 + 125 * e ^ 0.3 }
  printf "law = \"table\"\nplastic_strain = [%s]\nflow_stress = [%s]", x, y }')
bond='[bond]
tensile_strength = 25.0
shear_strength = 18.0
fracture_energy = 0.5'

compaction='[[stages]]
name = "compaction"
type = "isotropic_compaction"
relative_density = RELATIVE_DENSITY
wall_speed = 4000.0'
triaxial='[[stages]]
name = "triaxial"
type = "triaxial_compression"
wall_speed = 4000.0
axial_strain = 0.2'

# compact NAME HARDENING BOND [OPTION...]: leaves NAME.toml, which goes on to 0.97, and NAME.compaction.checkpoint.h5
compact() {
  { scenario "$2" "$3" && echo "${compaction/RELATIVE_DENSITY/0.90}"; } >"$work/first.toml"
  "$mpfem" run --quiet "$work/first.toml" -o "$work/$1.h5" "${@:4}" >/dev/null
  { scenario "$2" "$3" && echo "${compaction/RELATIVE_DENSITY/0.97}"; } >"$work/$1.toml"
}
compact bonds "$power" "$bond"
compact smooth "$power" "$bond" --set contact.surface="smooth"
compact plain "$power" ""
compact table "$table" "$bond"
{ scenario "$power" "$bond" && echo "$triaxial"; } >"$work/triaxial.toml"
cp "$work/bonds.compaction.checkpoint.h5" "$work/triaxial.compaction.checkpoint.h5"

# NAME | SCENARIO | OPTIONS
cases='bonds, as the paper has them|bonds|
no bonds|plain|
hardening from a table|table|
no bulk viscosity|bonds|--set numerics.bulk_viscosity_linear=0 --set numerics.bulk_viscosity_quadratic=0
damping|bonds|--set stages.0.damping_rate=2e6 --set stages.0.damping_fade_stress=1e4
speed chosen by the stage|bonds|--set stages.0.quasi_static.stress_tolerance=0.05
lateral walls servo-held (triaxial)|triaxial|
step by single tets|bonds|--set numerics.step_estimate="tet"
smooth contact surface|smooth|--set contact.surface="smooth"
tet4-anp|bonds|--set element.type="tet4-anp"
tet4-patch|bonds|--set element.type="tet4-patch"
mixed precision|bonds|--set element.precision="mixed"'

# shellcheck source=tests/benchmarks/medians.sh
. "$(dirname "${BASH_SOURCE[0]}")/medians.sh"

for ((repetition = 1; repetition <= repetitions; ++repetition)); do
  i=0
  while IFS='|' read -r _ scene options; do
    # shellcheck disable=SC2086 # options are several words
    "$mpfem" bench "$work/$scene.toml" --from "$work/$scene.compaction.checkpoint.h5" --quiet --json --steps 600 \
      $options >"$work/$i.$repetition.json"
    i=$((i + 1))
  done <<<"$cases"
done

printf 'ns per tetrahedron and step, medians of %s, %s tets, all cores\n\n' "$repetitions" \
  "$(value "$work/0.1.json" tets)"
printf '| case | whole step | elements | contact | surface | step estimate | integration '
printf '| memory, bytes per tetrahedron |\n'
printf '|---|---|---|---|---|---|---|---|\n'
i=0
while IFS='|' read -r name _ _; do
  printf '| %s ' "$name"
  for part in whole_step elements contact surface step_estimate integration memory; do
    key=${part}_ns_per_tet_step
    [[ $part == memory ]] && key=memory_bytes_per_tet
    printf '| %.3g ' "$(median "$key" "$work/$i".*.json)"
  done
  printf '|\n'
  i=$((i + 1))
done <<<"$cases"
