#!/usr/bin/env bash
# What tools and friction cost: tests/benchmarks/tools.sh [BIN [SIZE [THREADS [TURNS]]]] > tools.md
#
# The 329 grains of the examples, in the box and in the round die, meshed at SIZE (0.03 mm), are pressed along z to a
# relative density of 0.85, and steps of what follows are measured: between walls of the box, between tools, with
# friction, with the die as triangles. Every case is measured TURNS times (3), in turn with the others, on THREADS (all
# cores); the medians are printed. Some five minutes.
set -euo pipefail

bin=${1:-build/bin}
top=$(realpath "$(dirname "${BASH_SOURCE[0]}")/../..")
mpfem=$bin/mpfem
size=${2:-0.03}
threads=()
[[ -z ${3:-} ]] || threads=(--threads "$3")
repetitions=${4:-3}

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

for shape in ph102 ph102_die; do
  "$bin/pack-gen" spheres --quiet "$top/pack-gen/examples/mcc_$shape.toml" -o "$work/spheres.h5"
  "$bin/pack-gen" mesh --quiet "$work/spheres.h5" --size "$size" -o "$work/$shape.h5"
done

# A round die as triangles, mm: 128 sides about x = y = 0.5, from z = -0.2 to 1.3. Tools keep grains inside.
awk 'function vertex(x, y, z) { return sprintf("  vertex %.9g %.9g %g\n", 0.5 + x, 0.5 + y, z) }
  function corner(i, z) { return vertex(r * cos(i * step), r * sin(i * step), z) }
  function facet(a, b, c) { printf "facet normal 0 0 0\n outer loop\n%s%s%s endloop\nendfacet\n", a, b, c }
  BEGIN {
    n = 128; step = 2 * atan2(0, -1) / n; r = 0.5 / cos(step / 2); low = -0.2; high = 1.3
    print "solid die"
    for (i = 0; i < n; ++i) {
      facet(corner(i, low), corner(i + 1, low), corner(i + 1, high))
      facet(corner(i, low), corner(i + 1, high), corner(i, high))
      facet(vertex(0, 0, low), corner(i + 1, low), corner(i, low))
      facet(vertex(0, 0, high), corner(i, high), corner(i + 1, high))
    }
    print "endsolid die"
  }' >"$work/die.stl"

# scenario PACKING STAGES
scenario() {
  cat <<EOF
packing = "$work/$1.h5"
[material]
density = 1.55e-9
youngs_modulus = 5000.0
poissons_ratio = 0.3
[material.hardening]
law = "power"
yield_stress = 25.0
coefficient = 125.0
exponent = 0.3
[contact]
stiffness_factor = 10.0
[output]
snapshot_at_stage_end = false
$2
EOF
}
walls='[[stages]]
name = "press"
type = "die_compression"
wall_speed = 4000.0
relative_density = DENSITY'
# tools DIE: the punches and a die, pressed
tools() {
  cat <<EOF
[[tools]]
name = "die"
$1
[[tools]]
name = "lower"
type = "plane"
face = "-z"
[[tools]]
name = "upper"
type = "plane"
face = "+z"
[[stages]]
name = "press"
type = "tools"
drive.lower.speed = 4000
drive.upper.speed = 4000
travel = TRAVEL
EOF
}
# The punches travel so far to D_r = 0.85, and are then pressed on.
travel=$(awk 'BEGIN { print 0.5 * 1.0917 * (1 - 0.552 / 0.85) }')

# press NAME PACKING STAGES [OPTION...]: leaves NAME.toml, which goes on, and NAME.press.checkpoint.h5
press() {
  local stages=${3/DENSITY/0.85}
  scenario "$2" "${stages/TRAVEL/$travel}" >"$work/first.toml"
  "$mpfem" run --quiet "$work/first.toml" -o "$work/$1.h5" "${threads[@]}" "${@:4}" >/dev/null
  stages=${3/DENSITY/0.95}
  scenario "$2" "${stages/TRAVEL/0.1}" >"$work/$1.toml"
  for option in "${@:4}"; do [[ $option == --set ]] || echo "--set $option"; done >"$work/$1.options"
}
round='type = "cylinder"'
triangles="type = \"stl\"
file = \"$work/die.stl\"
scale = 1
grains = \"inside\""
rubbing=(--set tools.0.friction=0.1 --set tools.1.friction=0.1 --set tools.2.friction=0.1)
press walls ph102 "$walls"
press rough-walls ph102 "$walls" --set walls.friction=0.1
press die ph102_die "$(tools "$round")"
press rough-die ph102_die "$(tools "$round")" "${rubbing[@]}"
press rough ph102_die "$(tools "$round")" --set contact.friction=0.3 "${rubbing[@]}"
press triangles ph102_die "$(tools "$triangles")"

# NAME|SCENE
cases='walls of the box, no friction|walls
walls of the box, friction 0.1 at walls|rough-walls
a cylinder and two planes, no friction|die
the same, friction 0.1 at tools|rough-die
the same, friction 0.1 at tools and 0.3 between grains|rough
the die of 512 triangles, no friction|triangles'

# shellcheck source=tests/benchmarks/medians.sh
. "$(dirname "${BASH_SOURCE[0]}")/medians.sh"

for ((repetition = 1; repetition <= repetitions; ++repetition)); do
  while IFS='|' read -r _ scene; do
    # shellcheck disable=SC2046 # options are several words
    "$mpfem" bench "$work/$scene.toml" --from "$work/$scene.press.checkpoint.h5" --quiet --json --steps 400 \
      "${threads[@]}" $(cat "$work/$scene.options") >"$work/$scene.$repetition.json"
  done <<<"$cases"
done

printf 'ns per tetrahedron and step, medians of %s, %s tets, %s\n\n' "$repetitions" "$(value "$work/die.1.json" tets)" \
  "${3:-all} threads"
printf '| case | whole step | elements | contact | surface | step estimate | integration |\n'
printf '|---|---|---|---|---|---|---|\n'
while IFS='|' read -r name scene; do
  printf '| %s ' "$name"
  for part in whole_step elements contact surface step_estimate integration; do
    printf '| %.3g ' "$(median "${part}_ns_per_tet_step" "$work/$scene".*.json)"
  done
  printf '|\n'
done <<<"$cases"
