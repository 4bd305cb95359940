#!/usr/bin/env bash
# Whether two builds compute bitwise the same: a fixed set of short scenarios on a packing of 25 grains, run by both,
# and every number of their histories and snapshots compared.
#
#   same-histories.sh BUILD_A BUILD_B          runs both in a temporary folder and compares (two minutes on a core)
#   same-histories.sh record BUILD FOLDER      packs, meshes and runs; the results stay in FOLDER
#   same-histories.sh compare FOLDER FOLDER    compares two such folders
#
# BUILD is a folder with bin/mpfem and bin/pack-gen. PACKING in the environment names a meshed packing to use instead of
# a new one. COMPARE names the program compare-results, build/bin/compare-results if not given.
# Exit code 0: all the same; 1: something differs or a run failed; 2: bad usage.
set -euo pipefail
here=$(realpath "$(dirname "${BASH_SOURCE[0]}")/../..")
compare=${COMPARE:-$here/build/bin/compare-results}

usage() {
  sed -n '2,11s/^# \{0,1\}//p' "${BASH_SOURCE[0]}" >&2
  exit 2
}

material='packing = "packing.h5"
[material]
density = 1.55e-9
youngs_modulus = 5000.0
poissons_ratio = 0.3
[material.hardening]
law = "power"
yield_stress = 25.0
coefficient = 125.0
exponent = 0.3
'
bond='[bond]
tensile_strength = 25.0
shear_strength = 18.0
fracture_energy = 0.05
'
output='[output]
history_rows = 20
snapshot_relative_densities = [0.5]
'
compaction='[[stages]]
name = "compaction"
type = "isotropic_compaction"
relative_density = 0.62
wall_speed = 30000.0
damping_rate = 1e6
damping_fade_stress = 5.0
'
unloading='[[stages]]
name = "unloading"
type = "isotropic_unloading"
mean_stress = 1.0
wall_speed = 20000.0
'
loadings='[[stages]]
name = "cycles"
type = "stress_cycles"
lowest_mean_stress = 5.0
highest_mean_stress = 15.0
cycles = 1
wall_speed = 10000.0
quasi_static = { kinetic_tolerance = 0.02, stress_tolerance = 0.1 }
[[stages]]
name = "triaxial"
type = "triaxial_compression"
hold = "force"
wall_speed = 10000.0
axial_strain = 0.02
[[stages]]
name = "probe"
type = "probe"
direction = [1.0, -1.0]
wall_speed = 5000.0
dissipation_ratio = 1.005
[[stages]]
name = "die"
type = "die_compression"
wall_speed = 10000.0
duration = 1e-6
[[stages]]
name = "hold"
type = "hold"
mean_stress = 15.0
duration = 6e-6
damping_rate = 1e6
damping_fade_stress = 1e4
[[stages]]
name = "unconfined"
type = "unconfined_compression"
wall_speed = 20000.0
axial_strain = 0.02
'
grip='[[stages]]
name = "grip"
type = "grip"
grip_depth = 0.05
displacement = 0.02
sliding = [0.005, 0.0, 0.0]
speed = 20000.0
'

# Fills `scenarios`, text by name.
declare -A scenarios
make_scenarios() {
  local facets='[contact]
surface = "facets"
' smooth='[contact]
surface = "smooth"
'
  element() { printf '[element]\ntype = "%s"\nprecision = "%s"\n' "$1" "$2"; }
  scenarios=(
    [tet4-facets]="$material$(element tet4 double)
$facets$output$compaction$unloading"
    [tet4-anp-smooth-loadings]="$material$(element tet4-anp double)
$smooth$output$compaction$loadings"
    [tet4-patch-bonds]="$material$(element tet4-patch double)
$smooth$bond$output$compaction$loadings"
    [bonds-exponential-grip]="$material$(element tet4-anp double)
$facets$bond"'rebond = "on_contact"
'"$output$compaction$unloading$grip"
    [bonds-energy-law-grip]="$material$(element tet4 double)
$smooth$bond"'softening = "energy"
'"$output$compaction$unloading$grip"
    [bonds-normal-only-grip]="$material$(element tet4 double)
$facets$bond"'normal_only = true
'"$output$compaction$unloading$grip"
    [mixed-anp-bonds]="$material$(element tet4-anp mixed)
$smooth$bond$output$compaction$unloading"
    [mixed-patch]="$material$(element tet4-patch mixed)
$facets$output$compaction$unloading"
    [mass-scaling]="$material$(element tet4 mixed)
[numerics]
mass_scaling_step = 6e-9
mass_scaling_lighten = true
$facets$bond$output$compaction$unloading"
    [step-of-tets]="$material$(element tet4-anp double)
[numerics]
step_estimate = \"tet\"
mass_scaling = 2.0
$smooth$output$compaction"
  )
}

# record BUILD FOLDER
record() {
  local bin=$1/bin folder=$2 name
  mkdir -p "$folder"
  if [[ -n ${PACKING:-} ]]; then
    cp "$PACKING" "$folder/packing.h5"
  else
    "$bin/pack-gen" spheres "$here/pack-gen/examples/mcc_ph102_smoke.toml" -o "$folder/spheres.h5" --quiet
    "$bin/pack-gen" mesh "$folder/spheres.h5" --size 0.04 -o "$folder/packing.h5" --quiet
  fi
  make_scenarios
  for name in "${!scenarios[@]}"; do
    printf '%s' "${scenarios[$name]}" >"$folder/$name.toml"
    "$bin/mpfem" run "$folder/$name.toml" -o "$folder/$name.h5" --threads 1 --quiet ||
      { echo "same-histories: $name: mpfem ends with exit code $?" >&2; return 1; }
  done
}

# compare FOLDER FOLDER
compare_folders() {
  local file failed=0
  for file in "$1"/*.h5; do
    [[ $file == *checkpoint.h5 || $file == *spheres.h5 ]] && continue
    printf '%-28s ' "$(basename "$file" .h5)"
    "$compare" "$file" "$2/$(basename "$file")" || failed=1
  done
  return "$failed"
}

if [[ ! -x $compare ]]; then
  echo "same-histories: error: $compare is missing: build the target compare-results" >&2
  exit 2
fi
case ${1:-} in
record) [[ $# == 3 ]] || usage; record "$2" "$3" ;;
compare) [[ $# == 3 ]] || usage; compare_folders "$2" "$3" ;;
*)
  [[ $# == 2 ]] || usage
  work=$(mktemp -d)
  trap 'rm -rf "$work"' EXIT
  record "$1" "$work/a"
  PACKING=$work/a/packing.h5 record "$2" "$work/b"
  compare_folders "$work/a" "$work/b"
  ;;
esac
